// Bytes as text (RFC 4648, base64 with padding), for what a JSON document must carry exactly.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace herr {

std::string base64_text(std::span<const std::byte> bytes);
// None when the text is not what base64_text() writes for some bytes.
std::optional<std::vector<std::byte>> bytes_from_base64(std::string_view text);

}  // namespace herr
