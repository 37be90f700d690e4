// Which kind of image a file is by its first bytes, before any library sees it.
// Before: an untrusted file. After: camera_image.cpp picks the one reader for that kind.
#pragma once

#include <filesystem>
#include <string_view>

namespace herr {

enum class ImageFormat { jpeg, png, exr };

// Throws InputError: neither JPEG, PNG nor EXR, or an extension that belies the content.
ImageFormat recognised_format(const std::filesystem::path& file, std::string_view first_bytes);
// As PictureReader calls the format.
const char* reader_name(ImageFormat format);
// Whether a file of this name, if it is sound, is decoded by the picture module.
bool needs_picture_module(const std::filesystem::path& file);

}  // namespace herr
