#include <glm/ext/matrix_transform.hpp>

#include "scenes/samples/generator/objects/objects.h"
#include "scenes/samples/generator/pictures/textures.h"
#include "scenes/samples/generator/shapes/box.h"
#include "scenes/samples/generator/shapes/lathe.h"

namespace herr::samples {

namespace {

using glm::vec3;

// The catchers of general.scene.json repeat these numbers.
constexpr float kHalfWidthM = 2.5f, kHeightM = 2.5f, kHalfLengthM = 5.0f;

// Adds a box to a part.
void put(Mesh& mesh, const vec3& lower, const vec3& upper, float metres_per_picture = 1.0f) {
  append(mesh, box(lower, upper, metres_per_picture), glm::mat4(1.0f));
}

// Seen from inside: corners counter-clockwise from the room.
Mesh walls() {
  const float x = kHalfWidthM, y = kHeightM, z = kHalfLengthM;
  Mesh mesh;
  for (const Mesh& side : {quad({vec3(-x, 0, -z), {x, 0, -z}, {x, y, -z}, {-x, y, -z}}),
                           quad({vec3(x, 0, z), {-x, 0, z}, {-x, y, z}, {x, y, z}}),
                           quad({vec3(-x, 0, z), {-x, 0, -z}, {-x, y, -z}, {-x, y, z}}),
                           quad({vec3(x, 0, -z), {x, 0, z}, {x, y, z}, {x, y, -z}})}) {
    append(mesh, side, glm::mat4(1.0f));
  }
  return mesh;
}

// Skirting, door and window frames, shelf boards: everything painted white.
Mesh woodwork() {
  const float x = kHalfWidthM, z = kHalfLengthM;
  Mesh mesh;
  put(mesh, {-x, 0, -z}, {x, 0.09f, -z + 0.018f});
  put(mesh, {-x, 0, -z}, {-x + 0.018f, 0.09f, z});
  put(mesh, {x - 0.018f, 0, -z}, {x, 0.09f, z});
  // Door frame in the back wall.
  put(mesh, {0.92f, 0, -z}, {1.00f, 2.10f, -z + 0.04f});
  put(mesh, {1.84f, 0, -z}, {1.92f, 2.10f, -z + 0.04f});
  put(mesh, {0.92f, 2.03f, -z}, {1.92f, 2.11f, -z + 0.04f});
  // Window in the left wall, from z = -3.2 to -1.4: frame, sill, cross.
  put(mesh, {-x, 0.85f, -3.28f}, {-x + 0.05f, 2.18f, -3.20f});
  put(mesh, {-x, 0.85f, -1.40f}, {-x + 0.05f, 2.18f, -1.32f});
  put(mesh, {-x, 2.10f, -3.28f}, {-x + 0.05f, 2.18f, -1.32f});
  put(mesh, {-x, 0.85f, -3.34f}, {-x + 0.16f, 0.90f, -1.26f});
  put(mesh, {-x, 0.90f, -2.325f}, {-x + 0.035f, 2.10f, -2.275f});
  put(mesh, {-x, 1.62f, -3.20f}, {-x + 0.035f, 1.66f, -1.40f});
  // Shelf on the right wall.
  for (const float height : {0.50f, 0.95f, 1.40f, 1.85f})
    put(mesh, {2.22f, height, -2.60f}, {x, height + 0.025f, -1.30f});
  put(mesh, {2.22f, 0.0f, -2.63f}, {x, 1.90f, -2.60f});
  put(mesh, {2.22f, 0.0f, -1.30f}, {x, 1.90f, -1.27f});
  return mesh;
}

Mesh door() {
  Mesh mesh;
  const float z = -kHalfLengthM;
  put(mesh, {1.00f, 0.005f, z}, {1.84f, 2.03f, z + 0.02f});
  for (const float low : {0.15f, 1.10f}) {
    for (const float left : {1.10f, 1.47f}) put(mesh, {left, low, z}, {left + 0.27f, low + 0.80f, z + 0.03f});
  }
  return mesh;
}

Mesh handle_and_lamp() {
  Mesh mesh;
  put(mesh, {1.75f, 1.00f, -4.98f}, {1.79f, 1.04f, -4.92f});
  put(mesh, {1.66f, 1.01f, -4.94f}, {1.79f, 1.03f, -4.92f});
  const Mesh stem = lathe({{0.0f, 0.0f, true},
                           {0.14f, 0.0f, true},
                           {0.14f, 0.02f, true},
                           {0.015f, 0.03f, true},
                           {0.012f, 1.45f, true},
                           {0.0f, 1.45f, true}},
                          {20, 2});
  append(mesh, stem, glm::translate(glm::mat4(1.0f), vec3(-2.05f, 0.0f, -4.45f)));
  return mesh;
}

Mesh books() {
  Mesh mesh;
  const float x = 2.27f;
  for (const float height : {0.525f, 0.975f, 1.425f}) {
    const float from = -2.58f + 0.3f * (height - 0.5f), to = from + 0.75f;
    put(mesh, {x + 0.01f, height, from}, {kHalfWidthM, height + 0.24f, to}, 10.0f);
    // Spines towards the room, one picture over the whole row.
    append(mesh,
           quad({vec3(x, height, from), {x, height, to}, {x, height + 0.25f, to}, {x, height + 0.25f, from}}),
           glm::mat4(1.0f));
  }
  return mesh;
}

Mesh table() {
  Mesh mesh;
  put(mesh, {-0.75f, 0.70f, 1.25f}, {0.75f, 0.74f, 2.05f}, 0.8f);
  put(mesh, {-0.67f, 0.60f, 1.33f}, {0.67f, 0.70f, 1.36f}, 0.8f);
  put(mesh, {-0.67f, 0.60f, 1.94f}, {0.67f, 0.70f, 1.97f}, 0.8f);
  for (const float x : {-0.70f, 0.64f}) {
    for (const float z : {1.30f, 1.94f}) put(mesh, {x, 0.0f, z}, {x + 0.06f, 0.70f, z + 0.06f}, 0.8f);
  }
  return mesh;
}

Mesh lamp_shade() {
  Mesh mesh;
  append(mesh,
         lathe({{0.22f, 1.38f, true}, {0.14f, 1.72f, true}, {0.135f, 1.72f, true}, {0.215f, 1.38f, true}},
               {32, 3}),
         glm::translate(glm::mat4(1.0f), vec3(-2.05f, 0.0f, -4.45f)));
  return mesh;
}

void add_shell(GlbObject& object) {
  const float x = kHalfWidthM, y = kHeightM, z = kHalfLengthM;
  object.parts.push_back({quad({vec3(-x, 0, z), {x, 0, z}, {x, 0, -z}, {-x, 0, -z}}, {2.5f, 5.0f}),
                          {"planks", vec3(1.0f), 0.0f, 0.55f, {}, planks_picture()}});
  object.parts.push_back({walls(), {"wall paint", {0.66f, 0.64f, 0.58f}, 0.0f, 0.9f, {}, {}}});
  // The lamp hangs 0.2 m below the ceiling: a white one would burn out in the camera's picture, so most of
  // its brightness is emitted evenly.
  object.parts.push_back({quad({vec3(-x, y, -z), {x, y, -z}, {x, y, z}, {-x, y, z}}),
                          {"ceiling", vec3(0.06f), 0.0f, 0.9f, {0.34f, 0.34f, 0.33f}, {}}});
  object.parts.push_back({woodwork(), {"white paint", vec3(0.80f), 0.0f, 0.6f, {}, {}}});
  object.parts.push_back({door(), {"door paint", {0.42f, 0.50f, 0.52f}, 0.0f, 0.6f, {}, {}}});
}

void add_pictures(GlbObject& object) {
  const float left = -kHalfWidthM + 0.01f, back = -kHalfLengthM + 0.03f;
  const vec3 white(1.0f);
  // Some emission stands for the daylight behind the glass.
  object.parts.push_back(
      {quad({vec3(left, 0.90f, -1.40f), {left, 0.90f, -3.20f}, {left, 2.10f, -3.20f}, {left, 2.10f, -1.40f}}),
       {"window", white, 0.0f, 0.3f, {0.20f, 0.24f, 0.28f}, sky_picture()}});
  object.parts.push_back(
      {quad({vec3(-1.15f, 1.05f, back), {-0.35f, 1.05f, back}, {-0.35f, 2.20f, back}, {-1.15f, 2.20f, back}}),
       {"poster", white, 0.0f, 0.7f, {}, poster_picture()}});
  const float above = 0.006f;  // clear of the floor
  object.parts.push_back(
      {quad({vec3(-1.2f, above, 0.6f), {1.2f, above, 0.6f}, {1.2f, above, -3.4f}, {-1.2f, above, -3.4f}}),
       {"rug", white, 0.0f, 0.95f, {}, rug_picture()}});
}

}  // namespace

GlbObject room() {
  GlbObject object{"room", {}};
  add_shell(object);
  add_pictures(object);
  object.parts.push_back({handle_and_lamp(), {"metal", {0.35f, 0.34f, 0.33f}, 1.0f, 0.4f, {}, {}}});
  object.parts.push_back(
      {lamp_shade(), {"lamp shade", {0.85f, 0.74f, 0.55f}, 0.0f, 0.9f, {0.35f, 0.28f, 0.16f}, {}}});
  object.parts.push_back({books(), {"books", vec3(1.0f), 0.0f, 0.7f, {}, books_picture()}});
  object.parts.push_back({table(), {"table wood", vec3(0.95f), 0.0f, 0.5f, {}, wood_picture()}});
  return object;
}

}  // namespace herr::samples
