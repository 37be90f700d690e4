// Nine boards before a seated viewer, three by three, that fill the field of view (paper, Figure 8).
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/samples/generator/objects/objects.h"
#include "scenes/samples/generator/pictures/test_charts.h"
#include "scenes/samples/generator/shapes/grid.h"

namespace herr::samples {
namespace {

constexpr float kDistance_m = 1.0f;
constexpr float kStep_rad = 38.0f * kPi / 180.0f;  // from board to board
constexpr float kHalf_rad = 18.5f * kPi / 180.0f;  // half of what a board spans

// A board whose middle lies at yaw (to the left) and pitch (upwards) from -Z; it faces the origin.
Mesh board(float yaw, float pitch) {
  const glm::vec3 away(-std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch));
  const glm::vec3 right = glm::normalize(glm::cross(away, glm::vec3(0, 1, 0)));
  const glm::vec3 up = glm::cross(right, away);
  const float half_m = kDistance_m * std::tan(kHalf_rad);
  return grid_mesh(1, 1, [&](float u, float v) {
    const glm::vec3 place =
        kDistance_m * away + half_m * ((2.0f * u - 1.0f) * right + (2.0f * v - 1.0f) * up);
    return Vertex{place, -away, {u, 1.0f - v}};
  });
}

}  // namespace

GlbObject quality_boards() {
  // Which picture hangs where, from the upper left.
  constexpr std::array<int, 9> kPictures{2, 0, 3, 0, 1, 2, 3, 2, 0};
  std::array<GlbPart, 4> parts;
  const std::array<Picture, 4> pictures{reading_page(), letter_chart(), line_chart(), resolution_chart()};
  const std::array<const char*, 4> names{"reading", "letters", "lines", "resolution"};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].material.name = names[i];
    parts[i].material.base_colour = glm::vec3(0.9f);
    parts[i].material.roughness = 0.95f;
    parts[i].material.picture = pictures[i];
  }
  for (std::size_t i = 0; i < kPictures.size(); ++i) {
    const auto column = static_cast<float>(i % 3), row = static_cast<float>(i / 3);
    const Mesh one = board((1.0f - column) * kStep_rad, (1.0f - row) * kStep_rad);
    append(parts[static_cast<std::size_t>(kPictures[i])].mesh, one, glm::mat4(1.0f));
  }
  return {"boards", {parts.begin(), parts.end()}};
}

}  // namespace herr::samples
