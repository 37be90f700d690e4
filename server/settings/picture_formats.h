// Formats in which a run keeps the pictures of its frames: the one list of them, and a set out of it. Before:
// --format. After: which files a frame has (results/frame_files.h), who encodes them
// (replay/picture_output.h).
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace herr {

enum class PictureFormat : std::uint8_t {
  png,  // a file for each picture: 8-bit sRGB as shown
  exr,  // one file with a part for each picture: half floats, values of the scene
};
// In the order in which a frame's files are made, and in which texts name them.
inline constexpr std::array kPictureFormats{PictureFormat::png, PictureFormat::exr};
const char* name_of(PictureFormat format);

class PictureFormats {
 public:
  constexpr PictureFormats() = default;  // none
  constexpr PictureFormats(PictureFormat format) : bits_(bit(format)) {}
  constexpr PictureFormats(std::initializer_list<PictureFormat> formats) {
    for (const PictureFormat format : formats) add(format);
  }
  constexpr void add(PictureFormat format) { bits_ |= bit(format); }
  constexpr bool has(PictureFormat format) const { return (bits_ & bit(format)) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr bool operator==(const PictureFormats&) const = default;

 private:
  static constexpr unsigned bit(PictureFormat format) { return 1u << static_cast<unsigned>(format); }
  unsigned bits_ = 0;
};

// "png", "exr", "png,exr", "none".
std::string text_of(PictureFormats formats);
// Names in any order, separated by single commas. Throws std::invalid_argument for an unknown, an empty or a
// repeated one, and for "none" beside others.
PictureFormats picture_formats_from(std::string_view text);

}  // namespace herr
