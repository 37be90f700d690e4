#include <algorithm>
#include <array>
#include <stdexcept>

#include "renderer/outside_view.h"
#include "sessions/camera/half_from_samples.h"
#include "sessions/files/input_error.h"
#include "sessions/text/plain_values.h"

namespace herr {
namespace {

constexpr const char* kHexDigits = "0123456789abcdef";

[[noreturn]] void refuse_colour(const std::string& text) {
  throw std::invalid_argument("'" + printable(text) +
                              "' is no sRGB colour; write RRGGBB in hexadecimal digits, for example " +
                              text_of(kPink) + ", or R,G,B in whole numbers to 255");
}

std::uint8_t hex_byte(const std::string& text, std::size_t at) {
  const auto digit = [&](std::size_t i) {
    const char c = text[i] >= 'A' && text[i] <= 'F' ? static_cast<char>(text[i] - 'A' + 'a') : text[i];
    const std::size_t value = std::string(kHexDigits).find(c);
    if (value == std::string::npos) refuse_colour(text);
    return value;
  };
  return static_cast<std::uint8_t>(16 * digit(at) + digit(at + 1));
}

}  // namespace

ShownColour shown_colour_from(const std::string& text) {
  constexpr std::size_t kHexLength = 6;
  if (std::count(text.begin(), text.end(), ',') == 2) {
    std::array<std::uint8_t, 3> parts{};
    std::size_t from = 0;
    for (std::uint8_t& part : parts) {
      const std::size_t end = text.find(',', from);
      try {
        part = static_cast<std::uint8_t>(whole_number_from(text.substr(from, end - from), 0, 255));
      } catch (const std::invalid_argument&) {
        refuse_colour(text);
      }
      from = end + 1;
    }
    return {parts[0], parts[1], parts[2]};
  }
  if (text.size() != kHexLength) refuse_colour(text);
  return {hex_byte(text, 0), hex_byte(text, 2), hex_byte(text, 4)};
}

std::string text_of(const ShownColour& colour) {
  std::string text;
  for (const std::uint8_t part : {colour.red, colour.green, colour.blue}) {
    text += kHexDigits[part / 16];
    text += kHexDigits[part % 16];
  }
  return text;
}

glm::vec3 radiance_of(const ShownColour& colour, float white) {
  const auto linear = [white](std::uint8_t part) {
    return white * static_cast<float>(linear_from_srgb(part / 255.0));
  };
  return {linear(colour.red), linear(colour.green), linear(colour.blue)};
}

}  // namespace herr
