// Two scans of real rooms: every part stands as in a room.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <iostream>

#include "scenes/document/room_scan.h"
#include "tests/paths.h"

namespace herr::test {
namespace {

std::filesystem::path scan_file(const std::string& name) {
  const char* folder = std::getenv("HERR_TEST_DATA");
  const std::filesystem::path data = folder != nullptr
                                         ? std::filesystem::path(folder)
                                         : std::filesystem::path(source_dir()) / "../shared/data";
  return data / "models/quest_rooms" / name;
}

// Floors face up, ceilings down, walls the middle of the room, and boxes stand upright. People's floors are
// level and walls upright within 3 degrees.
void expect_a_room(const Scene& scene) {
  const double slant = std::sin(3 * 3.14159265358979 / 180);
  const Bounds bounds = scene_bounds(scene);
  const glm::dvec3 middle = 0.5 * (bounds.lower + bounds.upper);
  for (const Instance& instance : scene.instances) {
    const std::string label = instance.name.substr(instance.name.find('/') + 1);
    const glm::dmat4x3& m = instance.world_from_object;
    const glm::dvec3 front =
        glm::dmat3(m[0], m[1], m[2]) * glm::dvec3(scene.meshes[instance.mesh].normals[0]);
    if (label == "FLOOR") {
      EXPECT_GT(front.y, 1 - slant);
    }
    if (label == "CEILING") {
      EXPECT_LT(front.y, -1 + slant);
    }
    if (label == "WALL_FACE") {
      EXPECT_LT(std::abs(front.y), slant);
      // A wall behind a corner of an L-shaped room may face past the middle.
      EXPECT_GT(glm::dot(front, middle - m[3]), -0.5) << instance.name;
    }
    const Bounds box = instance_bounds(scene, instance);
    EXPECT_GT(box.lower.y, bounds.lower.y - 1e-6);
    if (label == "TABLE" || label == "COUCH" || label == "STORAGE") {
      // Furniture stands on the floor.
      EXPECT_NEAR(box.lower.y, bounds.lower.y, 0.1) << instance.name;
    }
  }
}

TEST(RoomScanData, RealRoomsStandUpright) {
  const std::vector<std::pair<const char*, std::size_t>> rooms{
      // Floor, ceiling, four walls; table, screen, plant as boxes.
      {"office_small.json", 9},
      // Floor, ceiling, six walls; four tables, couch, storage, two lamps as boxes.
      {"living_room.json", 16}};
  for (const auto& [name, parts] : rooms) {
    if (!std::filesystem::exists(scan_file(name))) GTEST_SKIP() << "no " << scan_file(name);
    Scene scene;
    Material material;
    material.name = "room";
    append_room_scan(scan_file(name), glm::dmat4x3{1.0}, material, scene);
    const Bounds bounds = scene_bounds(scene);
    std::cout << name << ": " << scene.instances.size() << " parts, " << bounds.upper.x - bounds.lower.x
              << " x " << bounds.upper.y - bounds.lower.y << " x " << bounds.upper.z - bounds.lower.z
              << " m\n";
    EXPECT_EQ(scene.instances.size(), parts) << name;
    expect_a_room(scene);
  }
}

}  // namespace
}  // namespace herr::test
