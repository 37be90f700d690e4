#include "tests/sessions/import/cameras/exif_bytes.h"

#include <zlib.h>

#include <cstdint>

namespace herr::test {
namespace {

std::string number(std::uint64_t value, std::size_t bytes, bool big_endian) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) {
    const std::size_t place = big_endian ? bytes - 1 - i : i;
    text += static_cast<char>(value >> (8 * place) & 0xff);
  }
  return text;
}

}  // namespace

// Header (8 bytes), a directory with one entry that points to the EXIF directory (2 + 12 + 4), that
// directory, texts.
std::string exif_of(const std::vector<std::pair<int, std::string>>& tags, bool big_endian) {
  const auto n = [big_endian](std::uint64_t value, std::size_t bytes) {
    return number(value, bytes, big_endian);
  };
  std::string bytes = (big_endian ? "MM" : "II") + n(42, 2) + n(8, 4);
  bytes += n(1, 2) + n(0x8769, 2) + n(4, 2) + n(1, 4) + n(26, 4) + n(0, 4);
  std::string entries = n(tags.size(), 2), texts;
  const std::size_t texts_at = 26 + 2 + 12 * tags.size() + 4;
  for (const auto& [tag, text] : tags) {
    const std::string whole = text + '\0';
    entries += n(static_cast<std::uint64_t>(tag), 2) + n(2, 2) + n(whole.size(), 4);
    if (whole.size() <= 4) {
      entries += whole + std::string(4 - whole.size(), '\0');
    } else {
      entries += n(texts_at + texts.size(), 4);
      texts += whole;
    }
  }
  return bytes + entries + n(0, 4) + texts;
}

std::string with_exif(const std::string& picture, const std::string& tiff) {
  if (picture[0] == '\xff') {
    const std::string body = std::string("Exif\0\0", 6) + tiff;
    return picture.substr(0, 2) + "\xff\xe1" + number(body.size() + 2, 2, true) + body + picture.substr(2);
  }
  const std::string chunk = "eXIf" + tiff;
  const auto sum = ::crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size()));
  return picture.substr(0, 33) + number(tiff.size(), 4, true) + chunk + number(sum, 4, true) +
         picture.substr(33);
}

}  // namespace herr::test
