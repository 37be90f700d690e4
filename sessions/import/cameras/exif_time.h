// When a picture was taken, as its camera wrote it: three tags of EXIF (2.31: 0x9003, 0x9291, 0x9011) in the
// APP1 segment of a JPEG, the eXIf chunk of a PNG, or the text chunk "Raw profile type exif" that exiv2 and
// ImageMagick write instead; all else is passed over. Before: a picture. After: picture_stamps.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace herr {

// Texts without the blanks and zeros that pad them.
struct ExifTime {
  std::string date;         // DateTimeOriginal, "2026:01:31 14:05:09"
  std::string sub_seconds;  // SubSecTimeOriginal, digits after the decimal point; may be empty
  std::string offset;       // OffsetTimeOriginal, "+01:00"; may be empty
};

// None: no EXIF, no DateTimeOriginal, or a blank one ("0000:00:00 00:00:00"); sub-seconds that are no digits
// count as none. Throws InputError where the file cannot be read, or its EXIF points outside itself.
std::optional<ExifTime> read_exif_time(const std::filesystem::path& file);

// The same of a TIFF structure, as EXIF is one; `file` is what errors name.
std::optional<ExifTime> exif_time_in(std::string_view tiff, const std::filesystem::path& file);

}  // namespace herr
