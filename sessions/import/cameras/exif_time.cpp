#include "sessions/import/cameras/exif_time.h"

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/streams/field_text.h"
#include "sessions/text/letters.h"

namespace herr {
namespace {

constexpr std::size_t kMostExifBytes = 1 << 20;
constexpr int kMostParts = 10000;  // segments or chunks of a file
constexpr std::size_t kMostTextBytes = 64;
constexpr std::uint16_t kExifIfd = 0x8769, kDateTimeOriginal = 0x9003, kSubSecTimeOriginal = 0x9291,
                        kOffsetTimeOriginal = 0x9011;
constexpr std::uint16_t kAscii = 2, kLong = 4;
constexpr std::size_t kEntryBytes = 12;

[[noreturn]] void fail_exif(const std::filesystem::path& file, const std::string& problem) {
  throw InputError(file, 0, problem, "export the picture again, or give the stamps another way");
}

// Numbers of a TIFF structure, each within it.
class Tiff {
 public:
  Tiff(std::string_view bytes, const std::filesystem::path& file) : bytes_(bytes), file_(file) {
    const std::string_view head = bytes.substr(0, 4);
    little_ = head == std::string_view("II*\0", 4);
    if (!little_ && head != std::string_view("MM\0*", 4)) fail_exif(file, "has EXIF data that are none");
  }

  std::size_t u16(std::size_t at) const { return number(at, 2); }
  std::size_t u32(std::size_t at) const { return number(at, 4); }
  std::string_view text(std::size_t at, std::size_t count) const {
    check(at, count);
    return bytes_.substr(at, count);
  }
  // Where the entry of a tag lies in the directory at `at`; 0: it has none.
  std::size_t entry(std::size_t at, std::uint16_t tag) const {
    const std::size_t count = u16(at);
    check(at + 2, count * kEntryBytes);
    for (std::size_t i = 0; i < count; ++i)
      if (u16(at + 2 + i * kEntryBytes) == tag) return at + 2 + i * kEntryBytes;
    return 0;
  }

 private:
  void check(std::size_t at, std::size_t count) const {
    if (at > bytes_.size() || count > bytes_.size() - at)
      fail_exif(file_, "has damaged EXIF data: they point outside themselves");
  }
  std::size_t number(std::size_t at, std::size_t count) const {
    check(at, count);
    std::size_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
      value = value << 8 | static_cast<unsigned char>(bytes_[at + (little_ ? count - 1 - i : i)]);
    return value;
  }

  std::string_view bytes_;
  const std::filesystem::path& file_;
  bool little_ = false;
};

// The text of a tag; empty where there is none.
std::string text_of_tag(const Tiff& tiff, std::size_t directory, std::uint16_t tag) {
  const std::size_t entry = tiff.entry(directory, tag);
  if (entry == 0 || tiff.u16(entry + 2) != kAscii) return {};
  const std::size_t count = tiff.u32(entry + 4);
  const std::size_t at = count <= 4 ? entry + 8 : tiff.u32(entry + 8);
  const std::string_view text = tiff.text(at, count).substr(0, kMostTextBytes);
  return std::string(trimmed(text.substr(0, text.find('\0'))));
}

// Without blanks and ends of lines before it.
std::string_view trimmed_lines(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text;
}

bool all_digits(const std::string& text) {
  return std::all_of(text.begin(), text.end(), is_digit);
}

std::string bytes_at(const InputFile& file, std::int64_t at, std::size_t count) {
  std::string bytes(count, '\0');
  bytes.resize(file.read_at(at, bytes.data(), count));
  return bytes;
}

std::size_t big_endian_at(std::string_view bytes, std::size_t at, std::size_t count) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// The segments before the pixels: FF, type, length of what follows with itself.
std::string exif_of_jpeg(const InputFile& file) {
  constexpr std::string_view kMagic("Exif\0\0", 6);
  std::int64_t at = 2;
  for (int part = 0; part < kMostParts; ++part) {
    const std::string head = bytes_at(file, at, 10);
    if (head.size() < 4 || head[0] != '\xff') return {};
    const auto type = static_cast<unsigned char>(head[1]);
    if (type == 0xff) {  // fill byte
      ++at;
      continue;
    }
    const std::size_t length = big_endian_at(head, 2, 2);
    if (type == 0xda || type == 0xd9 || length < 2) return {};  // pixels, end
    if (type == 0xe1 && length >= 8 && head.size() == 10 && head.substr(4) == kMagic)
      return bytes_at(file, at + 10, length - 8);
    at += static_cast<std::int64_t>(2 + length);
  }
  return {};
}

int hex_value(char c) {
  if (is_digit(c)) return c - '0';
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

// zlib's stream, of which no more than a megabyte is read; empty where it is damaged.
std::string inflated(std::string_view packed) {
  std::string bytes(kMostExifBytes, '\0');
  auto size = static_cast<uLongf>(bytes.size());
  const int result =
      uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                 static_cast<uLong>(packed.size()));
  bytes.resize(result == Z_OK ? size : 0);
  return bytes;
}

// "Raw profile type exif", as ImageMagick and exiv2 write it into a text chunk: a name, a length, hexadecimal
// digits of "Exif\0\0" and the TIFF structure. Empty where `text` is something else.
std::string exif_of_raw_profile(std::string_view text) {
  std::string_view rest = trimmed_lines(text);
  if (!rest.starts_with("exif\n")) return {};
  rest = trimmed_lines(rest.substr(5));
  rest.remove_prefix(std::min(rest.find('\n'), rest.size()));
  std::string bytes;
  int high = -1;
  for (const char c : rest) {
    const int value = hex_value(c);
    if (value < 0) continue;
    if (high >= 0) bytes += static_cast<char>(high << 4 | value);
    high = high >= 0 ? -1 : value;
  }
  constexpr std::string_view kMagic("Exif\0\0", 6);
  return bytes.starts_with(kMagic) ? bytes.substr(kMagic.size()) : bytes;
}

std::string exif_of_text_chunk(const std::string& type, std::string_view data) {
  constexpr std::string_view kKeyword("Raw profile type exif\0", 22);
  if (!data.starts_with(kKeyword)) return {};
  data.remove_prefix(kKeyword.size());
  if (type == "tEXt") return exif_of_raw_profile(data);
  if (data.empty() || data.front() != 0) return {};  // the only method of compression
  return exif_of_raw_profile(inflated(data.substr(1)));
}

// Chunks: length of the data, type, data, checksum.
std::string exif_of_png(const InputFile& file) {
  std::int64_t at = 8;
  for (int part = 0; part < kMostParts; ++part) {
    const std::string head = bytes_at(file, at, 8);
    if (head.size() < 8 || head.substr(4) == "IEND") return {};
    const std::size_t length = big_endian_at(head, 0, 4);
    if (head.substr(4) == "eXIf") {
      if (length > kMostExifBytes) fail_exif(file.path(), "has EXIF data of more than a megabyte");
      return bytes_at(file, at + 8, length);
    }
    const std::string type = head.substr(4);
    if ((type == "zTXt" || type == "tEXt") && length <= kMostExifBytes) {
      const std::string exif = exif_of_text_chunk(type, bytes_at(file, at + 8, length));
      if (!exif.empty()) return exif;
    }
    at += static_cast<std::int64_t>(12 + length);
  }
  return {};
}

}  // namespace

std::optional<ExifTime> exif_time_in(std::string_view bytes, const std::filesystem::path& file) {
  const Tiff tiff(bytes, file);
  const std::size_t pointer = tiff.entry(tiff.u32(4), kExifIfd);
  if (pointer == 0 || tiff.u16(pointer + 2) != kLong) return std::nullopt;
  const std::size_t directory = tiff.u32(pointer + 8);
  ExifTime time;
  time.date = text_of_tag(tiff, directory, kDateTimeOriginal);
  const bool blank = time.date.find_first_of("123456789") == std::string::npos;
  if (blank) return std::nullopt;
  time.sub_seconds = text_of_tag(tiff, directory, kSubSecTimeOriginal);
  if (!all_digits(time.sub_seconds)) time.sub_seconds.clear();
  time.offset = text_of_tag(tiff, directory, kOffsetTimeOriginal);
  return time;
}

std::optional<ExifTime> read_exif_time(const std::filesystem::path& path) {
  const InputFile file(path);
  const std::string start = bytes_at(file, 0, 8);
  std::string tiff;
  if (start.starts_with("\xff\xd8")) tiff = exif_of_jpeg(file);
  if (start == "\x89PNG\r\n\x1a\n") tiff = exif_of_png(file);
  if (tiff.empty()) return std::nullopt;
  return exif_time_in(tiff, path);
}

}  // namespace herr
