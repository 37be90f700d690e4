#include "server/settings/picture_formats.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "sessions/text/plain_values.h"

namespace herr {
namespace {

constexpr const char* kNone = "none";

// As people write after a comma.
std::string without_blanks(std::string_view word) {
  const std::size_t from = std::min(word.find_first_not_of(' '), word.size());
  return std::string(word.substr(from, word.find_last_not_of(' ') + 1 - from));
}

std::vector<std::string> known_words() {
  std::vector<std::string> words;
  for (const PictureFormat format : kPictureFormats) words.emplace_back(name_of(format));
  words.emplace_back(kNone);
  return words;
}

}  // namespace

const char* name_of(PictureFormat format) {
  switch (format) {
    case PictureFormat::png:
      return "png";
    case PictureFormat::exr:
      return "exr";
  }
  return "unknown";
}

std::string text_of(PictureFormats formats) {
  std::string text;
  for (const PictureFormat format : kPictureFormats)
    if (formats.has(format)) text += (text.empty() ? "" : ",") + std::string(name_of(format));
  return text.empty() ? kNone : text;
}

PictureFormats picture_formats_from(std::string_view text) {
  PictureFormats formats;
  if (text == kNone) return formats;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::size_t index = word_from(without_blanks(text.substr(at, end - at)), known_words());
    if (index == kPictureFormats.size()) {
      throw std::invalid_argument("'none' stands beside a format; give one of the two");
    }
    const PictureFormat format = kPictureFormats.at(index);
    if (formats.has(format)) {
      throw std::invalid_argument(std::string("'") + name_of(format) + "' is named twice; name it once");
    }
    formats.add(format);
    at = end + 1;
  }
  return formats;
}

}  // namespace herr
