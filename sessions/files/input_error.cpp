#include "sessions/files/input_error.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace herr {
namespace {

constexpr std::size_t kPrintableBytes = 200;
constexpr std::size_t kPathBytes = 4096;  // PATH_MAX: a path that was cut would not help to find the file
constexpr std::size_t kMessageBytes = 2000;

// Length in bytes of the well-formed UTF-8 character at the start of `text`, or 0 (Unicode table 3-7).
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const unsigned char second = byte(1);
  const bool overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool surrogate = first == 0xed && second > 0x9f;
  const bool too_large = first == 0xf4 && second > 0x8f;
  return overlong || surrogate || too_large ? 0 : length;
}

// C0, DEL and C1 (U+0080 to U+009F): a terminal may take them as commands.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (first < 0x20 || first == 0x7f) return true;
  return first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
}

// One character at the start of `text`, `length` bytes long (0: a byte that is no
// character), made safe to print.
std::string escaped_character(std::string_view text, std::size_t length) {
  static constexpr char kHex[] = "0123456789abcdef";
  if (length > 0 && !is_control(text.substr(0, length))) return std::string(text.substr(0, length));
  std::string out;
  for (std::size_t i = 0; i < std::max<std::size_t>(length, 1); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    out += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
  }
  return out;
}

std::string escaped(std::string_view text, std::size_t limit) {
  static constexpr std::string_view kCut = "...";
  std::string out;
  std::size_t cut_at = 0;  // end of the last character that leaves room for kCut
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    out += escaped_character(text, length);
    if (out.size() > limit) return out.substr(0, cut_at).append(kCut);
    if (out.size() + kCut.size() <= limit) cut_at = out.size();
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

}  // namespace

std::string InputError::message(const Parts& parts) {
  std::string text = parts.file;
  if (parts.line > 0) text += ":" + std::to_string(parts.line);
  if (!text.empty()) text += ": ";
  text += parts.problem;
  if (!parts.remedy.empty()) text += "; " + parts.remedy;
  return text;
}

InputError::InputError(std::shared_ptr<const Parts> parts)
    : std::runtime_error(message(*parts)), parts_(std::move(parts)) {}

InputError::InputError(const std::filesystem::path& file, std::int64_t line, const std::string& problem,
                       const std::string& remedy)
    : InputError(std::make_shared<const Parts>(Parts{escaped(file.native(), kPathBytes),
                                                     escaped(problem, kMessageBytes),
                                                     escaped(remedy, kMessageBytes), line})) {}

std::string printable(const std::string& text) {
  return escaped(text, kPrintableBytes);
}

}  // namespace herr
