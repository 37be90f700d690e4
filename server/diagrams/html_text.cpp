#include "server/diagrams/html_text.h"

#include <cstddef>
#include <cstdint>

namespace herr {
namespace {

// Bytes of the character that begins at `at`; 0: no whole UTF-8 character (RFC 3629), or a control character.
std::size_t clean_bytes(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) -> std::uint32_t {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u;
  };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  std::uint32_t code = first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3F);
  }
  // Below 0xA0 are two-byte forms of ASCII and the control characters of terminals.
  constexpr std::uint32_t kLowest[] = {0xA0, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code < kLowest[length - 2] || code > 0x10FFFF || surrogate || first < 0xC2 ? 0 : length;
}

}  // namespace

std::string clean_text(const std::string& text) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string clean;
  clean.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = clean_bytes(text, at);
    if (bytes == 0) {
      const auto byte = static_cast<unsigned char>(text[at++]);
      clean += {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
    } else {
      clean.append(text, at, bytes);
      at += bytes;
    }
  }
  return clean;
}

std::string html_text(const std::string& text) {
  std::string escaped;
  for (const char c : clean_text(text)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string html_element(const std::string& name, const std::string& attributes, const std::string& content) {
  return "<" + name + (attributes.empty() ? "" : " " + attributes) + ">" + content + "</" + name + ">";
}

}  // namespace herr
