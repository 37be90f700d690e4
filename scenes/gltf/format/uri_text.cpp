#include "scenes/gltf/format/uri_text.h"

#include <cstddef>
#include <cstdint>

namespace herr {
namespace {

constexpr std::string_view kDataScheme = "data:", kBase64 = ";base64";

// -1: none.
int hex_digit(char digit) {
  if (digit >= '0' && digit <= '9') return digit - '0';
  if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
  if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
  return -1;
}

int base64_digit(char digit) {
  if (digit >= 'A' && digit <= 'Z') return digit - 'A';
  if (digit >= 'a' && digit <= 'z') return digit - 'a' + 26;
  if (digit >= '0' && digit <= '9') return digit - '0' + 52;
  if (digit == '+') return 62;
  return digit == '/' ? 63 : -1;
}

UriData base64_data(std::string_view text) {
  UriData data;
  data.bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char letter : text) {
    if (letter == '=') break;  // padding ends the text
    if (letter == ' ' || letter == '\n' || letter == '\r' || letter == '\t') continue;
    const int digit = base64_digit(letter);
    if (digit < 0) return {{}, "holds a character that is none of base64"};
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    data.bytes.push_back(static_cast<unsigned char>(bits >> held & 0xff));
  }
  return data;
}

}  // namespace

std::string percent_decoded(std::string_view uri) {
  std::string text;
  text.reserve(uri.size());
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
    if (low < 0) {
      text += uri[i];
      continue;
    }
    text += static_cast<char>(16 * high + low);
    i += 2;
  }
  return text;
}

bool is_data_uri(std::string_view uri) {
  return uri.starts_with(kDataScheme);
}

UriData data_of_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return {{}, "has no comma before its data"};
  const std::string_view kind = uri.substr(0, comma), text = uri.substr(comma + 1);
  UriData data;
  if (!kind.ends_with(kBase64)) {
    const std::string plain = percent_decoded(text);
    data.bytes.assign(plain.begin(), plain.end());
  } else if (text.find('%') != std::string_view::npos) {
    data = base64_data(percent_decoded(text));
  } else {
    data = base64_data(text);
  }
  if (data.problem == nullptr && data.bytes.empty()) data.problem = "holds no data";
  return data;
}

}  // namespace herr
