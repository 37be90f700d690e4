// What there is to see: meshes, materials, textures, instances, lights - flattened to one level, ready for
// tracing. Before: scene_document reads *.scene.json and gltf files into this. After: renderer/geometry
// builds Embree scenes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/model/animated_model.h"
#include "scenes/model/exposure.h"
#include "scenes/model/material.h"
#include "scenes/model/object_path.h"
#include "scenes/model/scene_change.h"
#include "scenes/model/slot_changes.h"
#include "scenes/model/voxel_grid.h"
#include "sessions/format/pose.h"

namespace herr {

// A coarser form of a mesh, for where the eye cannot tell.
struct CoarserMesh {
  std::uint32_t mesh = 0;  // index into Scene::meshes
  float error_m = 0;       // how far its surface lies from the full one's, in object space
};

// One triangle mesh with one material (a glTF primitive). Arrays are all the same length or empty.
struct TriangleMesh {
  std::string name;
  std::vector<glm::vec3> positions;              // metres in object space, finite
  std::vector<glm::vec3> normals;                // unit; always present (generated when the file has none)
  std::vector<glm::vec2> uvs;                    // empty when the material has no texture
  std::vector<std::vector<glm::vec2>> more_uvs;  // sets 1, 2, ...; used where textures differ in coordinates
  // xyz unit, w = 1 or -1: the bitangent is w cross(normal, xyz). Empty unless a normal texture reads them.
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec4> colours;  // of vertices, linear RGBA in [0, 1]; empty = white
  bool closed = false;             // known to be closed with its fronts outside: its backs show from within
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices < positions.size()
  std::vector<CoarserMesh> coarser;  // by ascending error; empty unless a document asks for detail levels
};

// What an instance shows. A sphere has radius 1 about the origin of object space, a box is [-1, 1]^3; both
// are met analytically, and a matrix makes them balls, ellipsoids, AABBs and OBBs.
// Voxels are a grid whose object space is counted in voxels.
enum class ShapeKind : std::uint8_t { mesh, sphere, box, voxels };

struct Instance {
  std::string name;
  std::uint32_t mesh = 0;               // of kind mesh: index into Scene::meshes
  std::uint32_t material = 0;           // index into Scene::materials
  glm::dmat4x3 world_from_object{1.0};  // as transform_checks.h has it
  bool catcher = false;                 // stand-in for a real surface: invisible, receives shadows
  ShapeKind kind = ShapeKind::mesh;
  std::uint32_t grid = 0;                // of kind voxels: index into Scene::voxel_grids
  bool present = true;                   // false: not there yet, or no longer
  glm::dmat4x3 placed_from_object{1.0};  // where it stands in its PlacedObject
  int model = -1, node = -1;             // which node of which Scene::models moves it within that; -1: none
};

// What a document places under one name: the instances from `first` on, which stand and move together.
struct PlacedObject {
  std::string name;
  Placement placement;
  std::uint32_t first = 0, count = 0;  // of Scene::instances
  bool present = true;                 // false: only there to be spawned
  ObjectPath path{};                   // empty: it stands at `placement`

  Placement start() const { return path.empty() ? placement : path.at(0); }  // at time 0
};

// box: radiates uniformly over its volume, into all directions. spot: from a point into a cone. sun: parallel
// light from infinitely far away.
enum class LightKind : std::uint8_t { box, spot, sun };

// A light that cannot be seen itself: an axis-aligned box (a point when it has no size), a spot, or a sun.
struct AreaLight {
  std::string name;
  LightKind kind = LightKind::box;
  // Part of the virtual world: it lights real surfaces, but the camera feed does not show its light yet.
  bool is_virtual = false;
  glm::dvec3 centre{0.0};
  glm::vec3 size{0.0f};            // metres, >= 0 per axis
  glm::vec3 intensity_w_sr{0.0f};  // >= 0; of a sun: irradiance in W/m^2 on a surface that faces it
  glm::dvec3 direction{0, -1, 0};  // in which a spot or sun shines, unit
  double inner_cone_rad = 0,
         outer_cone_rad = 0.7853981633974483;  // of a spot: full brightness, none; half angles
  double range_m = 0;                          // where a box or spot ends; 0: nowhere
  // Circular path in the horizontal plane about `centre`: radius 0 = static.
  double path_radius_m = 0, path_period_s = 0, path_phase_deg = 0;
};

// An equirectangular picture of what lies outside the scene. Row 0 is the zenith; the middle column lies
// towards -Z, turned by turn_deg counter-clockwise as seen from above; columns run clockwise.
struct EnvironmentImage {
  int width_px = 0, height_px = 0;
  float turn_deg = 0;
  std::vector<float> rgba;  // 4 * width * height, radiance, finite and >= 0; the
                            // fourth is unused
};

struct Bounds {
  glm::dvec3 lower{0.0}, upper{0.0};
};

// A regular grid of light probes over a box: the scene's bounds where the document names none.
inline constexpr int kMostProbes = 65536;
struct ProbeGridSpec {
  std::array<int, 3> counts{16, 8, 16};  // >= 1 each, kMostProbes together
  std::optional<Bounds> box;
};

struct Scene {
  std::string name;
  std::vector<TriangleMesh> meshes;
  std::vector<Material> materials;
  std::vector<TextureImage> textures;
  std::vector<VoxelGrid> voxel_grids;
  std::vector<Instance> instances;
  std::vector<AreaLight> lights;
  std::vector<PlacedObject> objects;
  std::vector<AnimatedModel> models;          // glTF files of which something moves by itself
  std::vector<MeshDeformation> deformations;  // meshes that bend with a model
  std::vector<SceneChange> timeline;          // of the document itself, sorted by time
  bool changes = false;                       // instances may move, come or go while it is rendered
  SlotChanges::Number revision = 0;           // of the last change that changes/world.h made to it
  glm::vec3 ambient{0.0f};                    // radiance of the constant ambient term
  glm::vec3 environment{0.0f};                // radiance that a ray sees which leaves the scene
  EnvironmentImage environment_map;           // instead of `environment` where it has pixels
  ProbeGridSpec probes;
  std::optional<Exposure> exposure;          // none: 0 EV
  Pose world_from_session;                   // where the recording stands in the scene
  std::vector<std::string> warnings;         // one line each
  std::vector<std::filesystem::path> files;  // every file that was read
};

// What changes over time, as of one frame. Instances, materials and lights change in the Scene itself,
// between two frames and by changes/world.h alone: `changes` says which of them did.
struct SceneState {
  std::vector<AreaLight> lights;       // centres moved along their paths
  SlotChanges changes;                 // since the scene was loaded
  std::vector<DeformationPose> poses;  // per Scene::deformations; empty: as the meshes were loaded
};

// Lights at `time_s` seconds after the session's start (any finite value). Pure; `out` keeps its storage, and
// what else it says. (changes/world.h takes the rest of a scene to a time.)
void scene_state_at(const Scene& scene, double time_s, SceneState& out);

// Box around one instance, in the world. Of a mesh without vertices: inverted (lower > upper).
Bounds instance_bounds(const Scene& scene, const Instance& instance);
// Box around every instance that is there and no catcher (of all if there are only catchers).
Bounds scene_bounds(const Scene& scene);
// Triangles of all instances that are there; those of catchers only if `catchers`. A mesh counts once for
// each instance, an analytic shape not at all.
std::int64_t triangle_count(const Scene& scene, bool catchers);

}  // namespace herr
