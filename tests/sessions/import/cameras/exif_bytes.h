// EXIF as cameras write it, byte by byte, for pictures of tests.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace herr::test {

// A TIFF structure with the tags given in an EXIF directory, each a text: {0x9003, "2026:01:31 14:05:09"}.
std::string exif_of(const std::vector<std::pair<int, std::string>>& tags, bool big_endian = false);

// The bytes of a JPEG with the structure as its first segment, of a PNG with it behind the header.
std::string with_exif(const std::string& picture, const std::string& tiff);

}  // namespace herr::test
