// 8-bit sRGB pixels to the bytes of a PNG file, in memory: the file itself is written elsewhere. No times in
// the file: same pixels, same bytes.
#pragma once

#include <cstdint>
#include <vector>

#include "server/output/srgb_table.h"

namespace herr {

// zlib's fastest level: level 6 takes six times as long for files a fifth smaller.
inline constexpr int kFastPngLevel = 1;

// `channels` 3 (RGB) or 4 (RGB with unassociated alpha). `out` keeps its storage. Thread-safe.
// Throws std::runtime_error when the encoder refuses.
void encode_png(const Srgb8Image& image, std::vector<std::uint8_t>& out, int level = kFastPngLevel);

}  // namespace herr
