// Planes of floats to the bytes of a single-part OpenEXR file, in memory. No times in the file: same planes,
// same bytes. Before: whoever has numbers to show. After: AtomicFile.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace herr {

struct FloatPlanes {
  int width_px = 0, height_px = 0;
  // Channel name and width_px * height_px values, rows from the top without padding.
  std::vector<std::pair<std::string, std::vector<float>>> channels;
  std::vector<std::pair<std::string, std::string>> notes;  // text attributes of the header
};

// `out` keeps its storage. Throws std::runtime_error when the encoder refuses.
void encode_float_exr(const FloatPlanes& planes, std::vector<std::uint8_t>& out);

}  // namespace herr
