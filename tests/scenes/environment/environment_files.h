// Pictures of environments written by tests, and what reading them gives. Before: a test says which bytes.
// After: environment_image reads them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/environment/environment_image.h"
#include "scenes/environment/exr_picture.h"
#include "scenes/environment/radiance_picture.h"
#include "sessions/files/input_error.h"
#include "tests/scenes/scene_files.h"
#include "tests/temporary_folder.h"

namespace herr::test {

struct ReadEnvironment {
  EnvironmentImage image;
  std::vector<std::string> remarks;
  std::string error;  // of an InputError; empty where it was read
  float value(int x, int y, int channel) const {
    return image.rgba[static_cast<std::size_t>(4 * (y * image.width_px + x) + channel)];
  }
};

// `reader` returns an EnvironmentImage and takes the remarks.
template <typename Reader>
ReadEnvironment read_by(const Reader& reader) {
  ReadEnvironment read;
  try {
    read.image = reader(read.remarks);
  } catch (const InputError& error) {
    read.error = error.what();
  }
  // A picture that is not twice as wide as high is always remarked; tests of small ones look at the others.
  std::erase_if(read.remarks, [](const std::string& remark) { return contains(remark, "it is stretched"); });
  return read;
}
inline ReadEnvironment read_environment(const std::filesystem::path& file) {
  return read_by([&](std::vector<std::string>& remarks) { return read_environment_image(file, remarks); });
}
// Of bytes in memory, without the look at the first ones.
inline ReadEnvironment read_hdr_bytes(const std::string& bytes) {
  return read_by([&](auto& remarks) { return read_radiance_picture(bytes, "sky.hdr", remarks); });
}
inline ReadEnvironment read_exr_bytes(const std::string& bytes) {
  return read_by([&](auto& remarks) { return read_exr_picture(bytes, "sky.exr", remarks); });
}

inline ReadEnvironment read_hdr(const std::string& bytes) {
  const TemporaryFolder folder;
  return read_environment(folder.write("sky.hdr", bytes));
}

// Lines of a header behind "#?RADIANCE", then the resolution.
inline std::string hdr_header(const std::string& lines, const std::string& resolution) {
  return "#?RADIANCE\n" + lines + "\n" + resolution + "\n";
}
inline std::string rgbe(int r, int g, int b, int e) {
  return {static_cast<char>(r), static_cast<char>(g), static_cast<char>(b), static_cast<char>(e)};
}
inline const std::string kRgbeFormat = "FORMAT=32-bit_rle_rgbe\n";

}  // namespace herr::test
