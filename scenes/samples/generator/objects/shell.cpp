#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>

#include "scenes/samples/generator/objects/objects.h"
#include "scenes/samples/generator/pictures/textures.h"
#include "scenes/samples/generator/shapes/grid.h"

namespace herr::samples {

namespace {

constexpr float kTurns = 6.5f;
constexpr float kGrowthPerTurn = 1.62f;
constexpr float kLip = 0.90f;  // share of the rows outside; the rest leads back into the mouth

// The wall at `turns` from the tip and angle around the tube: a logarithmic helico-spiral (Raup 1966),
// 1 at the last whorl. `shrink` < 1 is the inside of the wall.
glm::vec3 wall(float turns, float around, float shrink) {
  const float size = std::pow(kGrowthPerTurn, turns - kTurns);
  const float angle = 2.0f * kPi * turns;
  // Ribs along the growth lines and cords along the whorl; a shoulder with blunt knobs.
  const float cords = 1.0f + 0.012f * std::cos(12.0f * around);
  const float knobs = 1.0f + 0.10f * std::pow(0.5f + 0.5f * std::cos(11.0f * angle), 3.0f) *
                                 std::pow(0.5f + 0.5f * std::cos(around - 0.9f), 4.0f);
  const float reach = 0.50f * shrink * cords * knobs;
  const float radius = size * (0.46f + reach * std::cos(around));
  const float height = -1.55f * size + size * 1.25f * reach * std::sin(around);
  return {radius * std::cos(angle), height, radius * std::sin(angle)};
}

Mesh shell_mesh() {
  return smooth_grid_mesh(40, 252, [](float u, float v) {
    const float around = 2.0f * kPi * u;
    if (v < kLip) {
      const float turns = kTurns * v / kLip;
      return Vertex{wall(turns, around, 1.0f), glm::vec3(0.0f), {u, v / kLip}};
    }
    // Over the lip and half a turn back inside, where the wall closes out of sight.
    const float back = (v - kLip) / (1.0f - kLip);
    const float lip = glm::smoothstep(0.0f, 0.12f, back), end = glm::smoothstep(0.85f, 1.0f, back);
    const float turns = kTurns + 0.01f * (lip - lip * lip) - 0.5f * back * back;
    const float shrink = (1.0f - 0.08f * lip) * (1.0f - 0.9999f * end);
    return Vertex{wall(turns, around, shrink), glm::vec3(0.0f), {u, 1.0f - 0.2f * back}};
  });
}

}  // namespace

GlbObject shell() {
  constexpr float kScaleM = 0.135f;
  const glm::mat4 identity(1.0f);
  // On its side, the mouth up and to the front.
  const glm::mat4 lying = glm::rotate(identity, 0.42f * kPi, glm::vec3(0, 0, 1));
  const glm::mat4 mouth = glm::rotate(identity, 0.80f * kPi, glm::vec3(0, 1, 0));
  Mesh mesh;
  append(mesh, shell_mesh(), glm::scale(identity, glm::vec3(kScaleM)) * lying * mouth);
  stand_on_ground(mesh);
  return {"shell", {{mesh, {"shell", glm::vec3(1.0f), 0.0f, 0.35f, {}, shell_picture()}}}};
}

}  // namespace herr::samples
