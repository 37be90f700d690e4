// Small RGB pictures and their PNG form. Before: textures paints them. After: glb_writer embeds them.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace herr::samples {

// 8-bit sRGB, rows from the top.
struct Picture {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgb;  // 3 * width * height
};

// Calls `colour` at each pixel's centre, uv in (0, 1) from the top left; the result is sRGB in [0, 1].
Picture paint(int width_px, int height_px, const std::function<glm::vec3(const glm::vec2& uv)>& colour);

// Throws std::runtime_error when encoding fails.
std::vector<std::uint8_t> encode_png(const Picture& picture);

}  // namespace herr::samples
