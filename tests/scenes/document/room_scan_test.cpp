// Room scans: where planes and boxes come to stand, which are left out, and what is said about bad ones.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>

#include "scenes/load_scene.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

json part(const char* label, std::array<double, 4> xyzw, std::array<double, 3> position) {
  return {{"uuid", "0"},
          {"semanticLabel_META", label},
          {"locatable_META",
           {{"orientation", {{"x", xyzw[0]}, {"y", xyzw[1]}, {"z", xyzw[2]}, {"w", xyzw[3]}}},
            {"position", {{"x", position[0]}, {"y", position[1]}, {"z", position[2]}}}}}};
}
json plane(json part, double width, double height) {
  part["bounded2D_META"] = {{"offset", {{"x", -width / 2}, {"y", -height / 2}}},
                            {"extent", {{"width", width}, {"height", height}}}};
  return part;
}
json box(json part, double width, double height, double depth) {
  part["bounded3D_META"] = {{"offset", {{"x", -width / 2}, {"y", -height / 2}, {"z", -depth}}},
                            {"extent", {{"width", width}, {"height", height}, {"depth", depth}}}};
  return part;
}

constexpr double kRoot = 0.70710678118654752;

// A floor that faces up (half a turn about x), a wall at z = 2 that faces into the room (half a turn about
// (0, 1, 1)), a table that was seen twice, a picture on the wall, and the mesh of everything.
json room() {
  json mesh = part("GLOBAL_MESH", {0, 0, 0, 1}, {0, 0, 0});
  mesh["triangleMesh_META"] = {{"vertices", ""}, {"indices", ""}};
  return {{"type", "scene"},
          {"version", 1},
          {"spatialEntities",
           {plane(part("FLOOR", {1, 0, 0, 0}, {0, 0, 0}), 4, 6),
            plane(part("WALL_FACE", {0, kRoot, kRoot, 0}, {0, 1.25, 2}), 4, 2.5),
            plane(part("TABLE", {1, 0, 0, 0}, {1, 0.72, 0}), 1.2, 0.6),
            box(part("TABLE", {-kRoot, 0, 0, kRoot}, {1, 0.7, 0}), 1.2, 0.6, 0.7),
            plane(part("WALL_ART", {0, kRoot, kRoot, 0}, {0, 1.5, 1.99}), 1, 1), mesh}}};
}

Scene load(const json& scan, const json& entry = {{"file", "scan.json"}}) {
  const TemporaryFolder folder;
  folder.write("scan.json", scan.dump());
  const json document = {{"format_version", 1}, {"name", "room"}, {"room_scan", entry}};
  return load_scene(folder.write("room.scene.json", document.dump()));
}

void expect_bounds(const Scene& scene, std::size_t i, const glm::dvec3& lower, const glm::dvec3& upper) {
  // Corners pass through float once, at coordinates of a few metres: 2^-22.
  const Bounds bounds = instance_bounds(scene, scene.instances[i]);
  EXPECT_LT(glm::distance(bounds.lower, lower), 1e-6) << i;
  EXPECT_LT(glm::distance(bounds.upper, upper), 1e-6) << i;
}

glm::dvec3 front(const Scene& scene, std::size_t i) {
  const Instance& instance = scene.instances[i];
  const glm::dmat4x3& m = instance.world_from_object;
  return glm::dmat3(m[0], m[1], m[2]) * glm::dvec3(scene.meshes[instance.mesh].normals[0]);
}

TEST(RoomScan, PlanesAndBoxesBecomeCatchersThatFaceTheRoom) {
  const Scene scene =
      load(room(), {{"file", "scan.json"}, {"name", "office"}, {"base_colour", {0.4, 0.5, 0.6}}});
  ASSERT_EQ(scene.instances.size(), 3u);  // without the table's second top, the picture and the mesh
  EXPECT_EQ(scene.instances[0].name, "office/FLOOR");
  EXPECT_EQ(scene.instances[2].name, "office/TABLE");
  expect_bounds(scene, 0, {-2, 0, -3}, {2, 0, 3});
  expect_bounds(scene, 1, {-2, 0, 2}, {2, 2.5, 2});
  // -90 degrees about x: depth becomes height, and hangs down from the top at 0.7 m.
  expect_bounds(scene, 2, {0.4, 0, -0.3}, {1.6, 0.7, 0.3});
  EXPECT_LT(glm::distance(front(scene, 0), glm::dvec3(0, 1, 0)), 1e-6);
  EXPECT_LT(glm::distance(front(scene, 1), glm::dvec3(0, 0, -1)), 1e-6);
  for (const Instance& instance : scene.instances) {
    EXPECT_TRUE(instance.catcher);
    EXPECT_EQ(instance.kind, ShapeKind::mesh);
    EXPECT_EQ(scene.materials[instance.material].base_colour, glm::vec3(0.4f, 0.5f, 0.6f));
  }
  EXPECT_EQ(scene.files.size(), 2u);
}

TEST(RoomScan, ARoomStandsWhereTheSceneSays) {
  // A quarter turn about y takes x to -z and z to x; then by (10, 0, 0).
  const Scene scene = load(
      room(), {{"file", "scan.json"}, {"translation", {10, 0, 0}}, {"rotation_xyzw", {0, kRoot, 0, kRoot}}});
  expect_bounds(scene, 1, {12, 0, -2}, {12, 2.5, 2});
}

TEST(RoomScan, EveryFaultIsAnInputErrorThatNamesTheField) {
  struct Fault {
    std::function<void(json&)> break_it;
    const char* expected;
  };
  const auto set = [](const char* pointer, json value) {
    return [pointer, value](json& scan) { scan[json::json_pointer(pointer)] = value; };
  };
  const std::vector<Fault> faults{
      {set("/type", "mesh"), "type"},
      {set("/version", 2), "version"},
      {set("/spatialEntities", 1), "spatialEntities"},
      {set("/spatialEntities/0", "floor"), "spatialEntities"},
      {set("/spatialEntities/0/semanticLabel_META", 7), "spatialEntities[0].semanticLabel_META"},
      {set("/spatialEntities/0/locatable_META/orientation/x", 0.5), "orientation"},
      {set("/spatialEntities/0/locatable_META/orientation/x", nullptr), "orientation.x"},
      {set("/spatialEntities/0/locatable_META/position/y", 1e30), "position.y"},
      {set("/spatialEntities/0/bounded2D_META/extent/width", 0), "extent.width"},
      {set("/spatialEntities/0/bounded2D_META/extent/height", -1), "extent.height"},
      {set("/spatialEntities/3/bounded3D_META/extent/depth", "deep"), "extent.depth"},
      {[](json& scan) { scan["spatialEntities"][3]["bounded3D_META"]["offset"].erase("z"); }, "offset.z"},
      {[](json& scan) { scan["spatialEntities"][0].erase("locatable_META"); }, "locatable_META"},
      {[](json& scan) { scan["spatialEntities"] = json::array_t(5000, scan["spatialEntities"][0]); }, "4096"},
  };
  for (const Fault& fault : faults) {
    json scan = room();
    fault.break_it(scan);
    try {
      load(scan);
      ADD_FAILURE() << "accepted, although " << fault.expected << " is wrong";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(fault.expected), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("scan.json"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(load(room(), {{"file", "scan.json"}, {"size", 2}}), InputError);
  EXPECT_THROW(load(room(), {{"file", "scan.json"}, {"scale", 2}}), InputError);
}

TEST(RoomScan, AScanWithoutAPlaneOrBoxIsAWarning) {
  json scan = room();
  scan["spatialEntities"] = json::array();
  const Scene scene = load(scan);
  EXPECT_TRUE(scene.instances.empty());
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("room scan"), std::string::npos);
}

}  // namespace
}  // namespace herr::test
