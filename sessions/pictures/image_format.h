// Which kind of image a file is by its first bytes, before any library sees it.
// Before: an untrusted file. After: camera_image.cpp picks the one reader for that kind.
#pragma once

#include <filesystem>
#include <string_view>

namespace herr {

enum class ImageFormat { jpeg, png, exr };

// Throws InputError: neither JPEG, PNG nor EXR, or an extension that belies the content.
ImageFormat recognised_format(const std::filesystem::path& file, std::string_view first_bytes);
// OpenImageIO's name of the reader.
const char* reader_name(ImageFormat format);

}  // namespace herr
