#include "scenes/environment/radiance_picture.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "scenes/environment/environment_limits.h"
#include "scenes/environment/radiance_header.h"
#include "scenes/environment/radiance_scanlines.h"

namespace herr {
namespace {

// Columns: XYZ of red, green and blue, scaled so that 1, 1, 1 is the white of Y 1. Chromaticities of
// Radiance's color.h (CIE_x_r ...), which differ from sRGB's in white (equal energy) and the x of green.
glm::dmat3 xyz_from_radiance_rgb() {
  const auto xyz = [](double x, double y) { return glm::dvec3(x / y, 1, (1 - x - y) / y); };
  const glm::dmat3 primaries(xyz(0.640, 0.330), xyz(0.290, 0.600), xyz(0.150, 0.060));
  const glm::dvec3 shares = glm::inverse(primaries) * xyz(1.0 / 3, 1.0 / 3);
  return {shares.x * primaries[0], shares.y * primaries[1], shares.z * primaries[2]};
}

// What a mantissa of 1 stands for, by exponent; 0 is black.
std::array<double, 256> mantissa_units() {
  std::array<double, 256> units{};
  for (int exponent = 1; exponent < 256; ++exponent) {
    units[static_cast<std::size_t>(exponent)] = std::ldexp(1.0, exponent - 136);
  }
  return units;
}

// Where pixel `i` of scanline `s` stands, rows from the top.
std::size_t upright(const RadianceLayout& layout, int s, int i) {
  int x = layout.columns ? s : i, y = layout.columns ? i : s;
  if (layout.leftwards) x = layout.width_px() - 1 - x;
  if (layout.up) y = layout.height_px() - 1 - y;
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(layout.width_px()) +
         static_cast<std::size_t>(x);
}

}  // namespace

EnvironmentImage read_radiance_picture(std::string_view bytes, const std::filesystem::path& file,
                                       std::vector<std::string>& remarks) {
  const RadianceHeader header = read_radiance_header(bytes, file);
  const RadianceLayout& layout = header.layout;
  check_environment_size(file, layout.width_px(), layout.height_px());
  const std::vector<std::uint8_t> coded = read_radiance_scanlines(bytes, header, file);
  remarks.insert(remarks.end(), header.remarks.begin(), header.remarks.end());

  EnvironmentImage image{layout.width_px(), layout.height_px(), 0, std::vector<float>(coded.size())};
  const glm::dvec3 multiplied(header.multiplied[0], header.multiplied[1], header.multiplied[2]);
  const glm::dmat3 rgb_from_xyz = glm::inverse(xyz_from_radiance_rgb());
  const std::array<double, 256> units = mantissa_units();
  std::int64_t changed = 0;
  const std::uint8_t* pixel = coded.data();
  for (int s = 0; s < layout.scanlines; ++s) {
    for (int i = 0; i < layout.scanline_px; ++i, pixel += 4) {
      glm::dvec3 rgb(pixel[0], pixel[1], pixel[2]);
      rgb *= units[pixel[3]];
      rgb /= multiplied;
      if (header.xyz) rgb = rgb_from_xyz * rgb;
      float* texel = &image.rgba[4 * upright(layout, s, i)];
      for (int c = 0; c < 3; ++c) texel[c] = radiance_in_range(rgb[c], changed);
    }
  }
  if (changed > 0) remarks.push_back(range_remark(changed));
  return image;
}

}  // namespace herr
