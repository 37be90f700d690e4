// The header of a Radiance picture (.hdr, .pic): how its pixels are coded, scaled and laid out. Before: the
// file's bytes. After: radiance_scanlines, radiance_picture. Format: Radiance's "File Formats" manual, Greg
// Ward: lines NAME=value up to an empty line, then the resolution; a line that begins with a blank or tab is
// of an earlier file and does not count.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace herr {

// "-Y 32 +X 64": 32 scanlines downwards, each of 64 pixels to the right. +Y scanlines go upwards, -X ones to
// the left; with X first, scanlines are columns.
struct RadianceLayout {
  int scanlines = 0, scanline_px = 0;
  bool columns = false;                // scanlines are columns of the picture
  bool leftwards = false, up = false;  // x goes down; y goes up
  int width_px() const { return columns ? scanlines : scanline_px; }
  int height_px() const { return columns ? scanline_px : scanlines; }
};

struct RadianceHeader {
  RadianceLayout layout;
  bool xyz = false;  // CIE XYZ instead of RGB
  // What all EXPOSURE and COLORCORR lines together multiplied the values by.
  std::array<double, 3> multiplied{1, 1, 1};
  std::size_t pixels_at = 0;         // byte of the first scanline
  std::vector<std::string> remarks;  // what is taken for granted or not used, one line each
};

// Throws InputError, which quotes the line: another FORMAT, no resolution, factors without a finite product.
// Sizes are above 0 and not checked further.
RadianceHeader read_radiance_header(std::string_view bytes, const std::filesystem::path& file);

}  // namespace herr
