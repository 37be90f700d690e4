#include "sessions/pictures/image_format.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "sessions/files/input_error.h"
#include "sessions/pictures/exr_header.h"

namespace herr {
namespace {

// Flags of an OpenEXR file's version field (OpenEXR file layout, "Version Field"), byte 5 of the file. They
// are refused before the library reads on: decoding such files has had memory errors.
void check_exr_flags(const std::filesystem::path& file, std::string_view bytes) {
  const auto flags = static_cast<unsigned char>(bytes[5]);
  if ((flags & 0x02) != 0) throw InputError(file, 0, "is a tiled EXR", exr_conversion());
  if ((flags & 0x08) != 0) throw InputError(file, 0, "is a deep EXR", exr_conversion("--flatten "));
  if ((flags & 0x10) != 0)
    throw InputError(file, 0, "is an EXR of several parts", exr_conversion("--subimage 0 "));
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace

ImageFormat recognised_format(const std::filesystem::path& file, std::string_view first_bytes) {
  const auto starts = [&](std::string_view magic) { return first_bytes.substr(0, magic.size()) == magic; };
  const std::string extension = lower_extension(file);
  bool matches = false;
  ImageFormat format = ImageFormat::jpeg;
  if (starts("\xff\xd8\xff")) {
    matches = extension == ".jpg" || extension == ".jpeg";
  } else if (starts("\x89PNG\r\n\x1a\n")) {
    format = ImageFormat::png;
    matches = extension == ".png";
  } else if (starts("\x76\x2f\x31\x01") && first_bytes.size() >= 8) {
    format = ImageFormat::exr;
    matches = extension == ".exr";
    check_exr_flags(file, first_bytes);
  } else {
    throw InputError(file, 0, first_bytes.empty() ? "is empty" : "is not a JPEG, PNG or OpenEXR image",
                     "convert the image");
  }
  if (!matches)
    throw InputError(file, 0, std::string("holds ") + reader_name(format) + " data under another extension",
                     "rename the file");
  return format;
}

const char* reader_name(ImageFormat format) {
  return format == ImageFormat::jpeg ? "jpeg" : format == ImageFormat::png ? "png" : "openexr";
}

bool needs_picture_module(const std::filesystem::path& file) {
  return lower_extension(file) == ".exr";
}

}  // namespace herr
