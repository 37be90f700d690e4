// Scene documents: what each field becomes, and what is said about each that is wrong.
#include <gtest/gtest.h>

#include <functional>
#include <glm/geometric.hpp>

#include "scenes/load_scene.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

json document() {
  return json::parse(R"({
    "format_version": 1, "name": "room",
    "gltf": [{"file": "models/model.gltf", "name": "lamp", "translation": [1, 2, 3], "scale": 2}],
    "catchers": [{"name": "floor", "box": {"min": [-1, -0.1, -2], "max": [1, 0, 2]}, "base_colour": [0.5, 0.4, 0.3]},
                 {"name": "wall", "quad": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]}],
    "lights": [{"name": "sun", "centre": [0, 3, 0], "size": [1, 0, 1], "intensity_w_sr": [10, 20, 30],
                "path": {"circle_radius_m": 2, "period_s": 8, "phase_deg": 90}}],
    "probes": {"counts": [4, 2, 8], "min": [-1, 0, -2], "max": [1, 2, 2]},
    "ambient": [0.1, 0.2, 0.3], "environment": [0.4, 0.5, 0.6],
    "world_from_session": {"position": [1, 0, 2], "orientation_xyzw": [0, 0, 0, 1]}})");
}

std::filesystem::path write_scene(const TemporaryFolder& folder, const json& scene) {
  folder.write("models/triangle.bin", triangle_bytes());
  folder.write("models/model.gltf", triangle_document().dump());
  return folder.write("room.scene.json", scene.dump());
}

TEST(SceneDocument, EveryFieldArrives) {
  const TemporaryFolder folder;
  const Scene scene = load_scene(write_scene(folder, document()));
  EXPECT_EQ(scene.name, "room");
  EXPECT_EQ(scene.ambient, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(scene.environment, glm::vec3(0.4f, 0.5f, 0.6f));
  EXPECT_EQ(scene.world_from_session.position, glm::dvec3(1, 0, 2));
  EXPECT_EQ(scene.probes.counts, (std::array{4, 2, 8}));
  ASSERT_TRUE(scene.probes.box);
  EXPECT_EQ(scene.probes.box->lower, glm::dvec3(-1, 0, -2));
  EXPECT_EQ(scene.probes.box->upper, glm::dvec3(1, 2, 2));
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].intensity_w_sr, glm::vec3(10, 20, 30));
  EXPECT_EQ(scene.lights[0].size, glm::vec3(1, 0, 1));
  EXPECT_EQ(scene.lights[0].path_radius_m, 2);
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_TRUE(scene.instances[0].catcher);
  EXPECT_TRUE(scene.instances[1].catcher);
  const Instance& lamp = scene.instances[2];
  EXPECT_FALSE(lamp.catcher);
  EXPECT_EQ(lamp.name, "lamp/node");
  EXPECT_EQ(lamp.world_from_object[0], glm::dvec3(2, 0, 0));
  EXPECT_EQ(lamp.world_from_object[3], glm::dvec3(1, 2, 3));
  // The document, the glTF and its buffer.
  EXPECT_EQ(scene.files.size(), 3u);
  EXPECT_TRUE(scene.warnings.empty());
}

struct Fault {
  const char* name;
  std::function<void(json&)> break_it;
  const char* expected;
};

void set(json& scene, const char* pointer, json value) {
  scene[json::json_pointer(pointer)] = std::move(value);
}

TEST(SceneDocument, EveryFaultIsAnInputErrorThatNamesTheField) {
  const std::vector<Fault> faults{
      {"unknown key", [](json& d) { set(d, "/lihgts", 1); }, "lights"},
      {"unknown key in a light", [](json& d) { set(d, "/lights/0/center", 1); }, "centre"},
      {"unknown key in probes", [](json& d) { set(d, "/probes/count", 1); }, "counts"},
      {"probes on an axis: none", [](json& d) { set(d, "/probes/counts/1", 0); }, "probes.counts"},
      {"probes on an axis: half", [](json& d) { set(d, "/probes/counts/1", 1.5); }, "probes.counts"},
      {"too many probes", [](json& d) { set(d, "/probes/counts/1", 65536); }, "probes.counts"},
      {"probes with half a box", [](json& d) { d["probes"].erase("max"); }, "probes"},
      {"probes inside out", [](json& d) { set(d, "/probes/max/2", -3); }, "probes.max"},
      {"unknown key in a path", [](json& d) { set(d, "/lights/0/path/radius", 1); }, "lights[0].path"},
      {"colour by another name", [](json& d) { set(d, "/gltf/0/material/color", 1); },
       "gltf[0].material.color is not known; did you mean 'base_colour'?"},
      {"rotation by another name", [](json& d) { set(d, "/gltf/0/rotation", 1); },
       "did you mean 'rotation_xyzw' (a quaternion x, y, z, w)?"},
      {"place of a light by another name", [](json& d) { set(d, "/lights/0/position", 1); },
       "lights[0].position is not known; did you mean 'centre' (metres)?"},
      {"a model of another format", [](json& d) { set(d, "/gltf/0/file", "models/x.obj"); },
       "gltf[0].file names models/x.obj, which is not of a format that can be shown; name a .gltf or .glb "
       "file "
       "(convert other models to .glb first)"},
      {"voxels as a model", [](json& d) { set(d, "/gltf/0/file", "models/x.vox"); },
       "move the entry to \"voxels\""},
      {"unknown key in an override", [](json& d) { set(d, "/gltf/0/material/metalic", 1); }, "metallic"},
      {"newer format", [](json& d) { set(d, "/format_version", 2); },
       "field format_version is 2, and this program reads version 1"},
      {"no format", [](json& d) { d.erase("format_version"); }, "format_version"},
      {"no name", [](json& d) { d.erase("name"); }, "name"},
      {"missing model", [](json& d) { set(d, "/gltf/0/file", "models/absent.glb"); }, "absent.glb"},
      {"missing generated model", [](json& d) { set(d, "/gltf/0/file", "generated/teapot.glb"); },
       "cmake --build"},
      {"model outside the folder", [](json& d) { set(d, "/gltf/0/file", "../model.gltf"); }, "gltf[0].file"},
      {"absolute model", [](json& d) { set(d, "/gltf/0/file", "/tmp/model.gltf"); }, "gltf[0].file"},
      {"empty model", [](json& d) { set(d, "/gltf/0/file", ""); }, "gltf[0].file"},
      {"scale 0", [](json& d) { set(d, "/gltf/0/scale", 0); }, "gltf[0].scale"},
      {"scale 0 on an axis",
       [](json& d) {
         set(d, "/gltf/0/scale", {1, 0, 1});
       },
       "gltf[0].scale"},
      {"scale too small", [](json& d) { set(d, "/gltf/0/scale", 1e-13); }, "gltf[0].scale"},
      {"scale of two numbers",
       [](json& d) {
         set(d, "/gltf/0/scale", {1, 1});
       },
       "gltf[0].scale"},
      {"rotation not unit",
       [](json& d) {
         set(d, "/gltf/0/rotation_xyzw", {0, 0, 0, 0.5});
       },
       "rotation_xyzw"},
      {"catcher with two shapes",
       [](json& d) {
         set(d, "/catchers/1/box", {{"min", {0, 0, 0}}, {"max", {1, 1, 1}}});
       },
       "catchers[1]"},
      {"catcher without a shape", [](json& d) { d["catchers"][1].erase("quad"); }, "catchers[1]"},
      {"box inside out", [](json& d) { set(d, "/catchers/0/box/max/0", -3); }, "catchers[0].box.max"},
      {"box that is a line",
       [](json& d) {
         set(d, "/catchers/0/box", {{"min", {0, 0, 0}}, {"max", {1, 0, 0}}});
       },
       "catchers[0].box.max"},
      {"quad of three corners", [](json& d) { d["catchers"][1]["quad"].erase(3); }, "catchers[1].quad"},
      {"quad with a corner of two numbers",
       [](json& d) {
         set(d, "/catchers/1/quad/2", {1, 1});
       },
       "catchers[1].quad[2]"},
      {"quad that is not flat",
       [](json& d) {
         set(d, "/catchers/1/quad/2", {1, 1, 0.5});
       },
       "not flat"},
      {"quad with crossed edges",
       [](json& d) {
         set(d, "/catchers/1/quad", {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0.5, 0}});
       },
       "convex"},
      {"quad without area",
       [](json& d) {
         set(d, "/catchers/1/quad", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
       },
       "no area"},
      {"colour beyond 1",
       [](json& d) {
         set(d, "/catchers/0/base_colour", {2, 0, 0});
       },
       "base_colour"},
      {"light without a centre", [](json& d) { d["lights"][0].erase("centre"); }, "lights[0].centre"},
      {"light of negative size",
       [](json& d) {
         set(d, "/lights/0/size", {-1, 0, 0});
       },
       "lights[0].size"},
      {"negative light",
       [](json& d) {
         set(d, "/lights/0/intensity_w_sr", {1, -1, 1});
       },
       "intensity_w_sr"},
      {"path of period 0", [](json& d) { set(d, "/lights/0/path/period_s", 0); }, "lights[0].path.period_s"},
      {"negative ambient",
       [](json& d) {
         set(d, "/ambient", {-1, 0, 0});
       },
       "ambient"},
      {"place too far",
       [](json& d) {
         set(d, "/world_from_session/position", {1e30, 0, 0});
       },
       "position"},
      {"lights that are no array", [](json& d) { set(d, "/lights", json::object()); }, "lights"},
  };
  for (const Fault& fault : faults) {
    const TemporaryFolder folder;
    json scene = document();
    fault.break_it(scene);
    const std::string message = error_of(write_scene(folder, scene));
    EXPECT_TRUE(contains(message, fault.expected)) << fault.name << ": \"" << message << '"';
    EXPECT_TRUE(contains(message, "room.scene.json")) << fault.name << ": \"" << message << '"';
  }
}

TEST(SceneDocument, AFileNamedTwiceIsLoadedOnce) {
  const TemporaryFolder folder;
  json scene = document();
  scene["gltf"].push_back({{"file", "models/../models/model.gltf"}});
  EXPECT_TRUE(contains(error_of(write_scene(folder, scene)), "gltf[1].file"));
  scene["gltf"][1]["file"] = "./models/model.gltf";
  const Scene loaded = load_scene(write_scene(folder, scene));
  ASSERT_EQ(loaded.instances.size(), 4u);
  EXPECT_EQ(loaded.instances[2].mesh, loaded.instances[3].mesh);
  EXPECT_EQ(loaded.instances[2].material, loaded.instances[3].material);
}

TEST(SceneDocument, FollowsLinksThatStayBelowItsFolderAndNoOthers) {
  const TemporaryFolder folder;
  folder.write("elsewhere/model.gltf", triangle_document().dump());
  folder.write("elsewhere/triangle.bin", triangle_bytes());
  json scene = document();
  scene["gltf"][0]["file"] = "models/link.gltf";
  const auto file = folder.write("scene/room.scene.json", scene.dump());
  folder.write("scene/models/triangle.bin", triangle_bytes());
  folder.write("scene/models/model.gltf", triangle_document().dump());
  const auto link = folder.path() / "scene/models/link.gltf";
  std::filesystem::create_symlink("model.gltf", link);
  EXPECT_EQ(load_scene(file).name, "room");
  std::filesystem::remove(link);
  std::filesystem::create_symlink(folder.path() / "elsewhere/model.gltf", link);
  const std::string refused =
      "gltf[0].file is \"models/link.gltf\", a link that leads out of the folder of the scene";
  EXPECT_NE(error_of(file).find(refused), std::string::npos) << error_of(file);
}

TEST(SceneDocument, AnOverrideChangesOneEntryAndTheMirrorFollowsTheSurface) {
  const TemporaryFolder folder;
  json scene = document();
  scene["gltf"].push_back(
      {{"file", "models/model.gltf"}, {"material", {{"metallic", 1}, {"roughness", 0.07}}}});
  scene["gltf"].push_back(
      {{"file", "models/model.gltf"}, {"catcher", true}, {"material", {{"mirror", 0.25}}}});
  const Scene loaded = load_scene(write_scene(folder, scene));
  const Material& plain = loaded.materials.at(loaded.instances.at(2).material);
  const Material& metal = loaded.materials.at(loaded.instances.at(3).material);
  const Material& mirror = loaded.materials.at(loaded.instances.at(4).material);
  // The default material of glTF: white, metallic 1, roughness 1.
  EXPECT_EQ(plain.roughness, 1.0f);
  EXPECT_FALSE(plain.mirror) << "by its roughness";
  EXPECT_FALSE(may_mirror(plain));
  EXPECT_FALSE(metal.mirror);
  EXPECT_TRUE(may_mirror(metal));
  EXPECT_EQ(mirror.mirror, 0.25f);
  EXPECT_TRUE(loaded.instances[4].catcher);
}

// Normals must point out of the box, and the triangles must turn the same way.
TEST(SceneDocument, ABoxCatcherIsClosedAndFacesOutwards) {
  const TemporaryFolder folder;
  const Scene scene = load_scene(write_scene(folder, document()));
  const TriangleMesh& box = scene.meshes.at(0);
  ASSERT_EQ(box.triangles.size(), 12u);
  double area = 0;
  for (const auto& triangle : box.triangles) {
    const glm::dvec3 a(box.positions[triangle[0]]), b(box.positions[triangle[1]]),
        c(box.positions[triangle[2]]);
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    EXPECT_GT(glm::dot(cross, glm::dvec3(box.normals[triangle[0]])), 0);
    EXPECT_GT(glm::dot(cross, a + b + c), 0);
    area += 0.5 * glm::length(cross);
  }
  // Box of 2 x 0.1 x 4: 2 * (2 * 4 + 0.1 * 4 + 2 * 0.1) = 17.2; half extents are
  // floats (relative error 6e-8).
  EXPECT_NEAR(area, 17.2, 17.2 * 4 * 6e-8);
}

TEST(SceneDocument, ABoxWithoutThicknessIsOneFaceUpwards) {
  const TemporaryFolder folder;
  json scene = document();
  scene["catchers"][0]["box"] = {{"min", {-1, 1e6, -1}}, {"max", {1, 1e6, 1}}};
  const Scene loaded = load_scene(write_scene(folder, scene));
  EXPECT_EQ(loaded.meshes.at(0).triangles.size(), 2u);
  EXPECT_EQ(loaded.meshes.at(0).normals.at(0), glm::vec3(0, 1, 0));
  EXPECT_EQ(loaded.instances.at(0).world_from_object[3].y, 1e6);
}

}  // namespace
}  // namespace herr::test
