// A light inside a body, on a surface, just above it and in its plane: E = (I / N) sum V cos / max(d^2, r^2),
// r half its longest edge, so that whatever the distance nothing reflects more than albedo / pi * I / r^2.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "server/study/relations/light/plain_scene.h"
#include "server/study/relations/picture_distance.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "server/study/report/figure_text.h"

namespace herr {
namespace {

constexpr double kPi = 3.14159265358979324;
constexpr int kNearLightSamples = 16;
// So wide that several rays fall where an unlimited falloff would be too bright: within (1e-3)^(1/3) r = 0.1
// r of a light that lies 1e-3 r above a surface.
constexpr double kRadiusOfDistance = 0.125;

struct SeenSpot {
  double distance_m = std::numeric_limits<double>::infinity();
  glm::dvec3 place{0}, normal{0};  // the normal looks to the eye
};

// A ray in some space; its parameter is the distance in the world.
struct SearchRay {
  glm::dvec3 origin, direction;
};

// Where the ray meets [-1, 1]^3 or another box, from outside.
std::optional<double> enters_box(const SearchRay& ray, const Bounds& box, int& axis_entered) {
  double near = -std::numeric_limits<double>::infinity(), far = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.lower[axis] - ray.origin[axis]) / ray.direction[axis],
                 b = (box.upper[axis] - ray.origin[axis]) / ray.direction[axis];
    if (std::min(a, b) > near) near = std::min(a, b), axis_entered = axis;
    far = std::min(far, std::max(a, b));
  }
  if (!(near <= far) || far < 0) return std::nullopt;
  return near;
}

void meet_triangles(const TriangleMesh& mesh, const SearchRay& ray, SeenSpot& spot, glm::dvec3& normal) {
  for (const auto& corners : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[corners[0]]);
    const glm::dvec3 u = glm::dvec3(mesh.positions[corners[1]]) - a,
                     v = glm::dvec3(mesh.positions[corners[2]]) - a;
    const glm::dvec3 n = glm::cross(u, v);
    const double facing = glm::dot(n, ray.direction);
    if (facing == 0) continue;
    const double t = glm::dot(n, a - ray.origin) / facing;
    if (!(t > 0 && t < spot.distance_m)) continue;
    // Barycentric coordinates by areas.
    const glm::dvec3 w = ray.origin + t * ray.direction - a;
    const double area2 = glm::dot(n, n);
    const double s = glm::dot(glm::cross(w, v), n) / area2, r = glm::dot(glm::cross(u, w), n) / area2;
    if (s < 0 || r < 0 || s + r > 1) continue;
    spot.distance_m = t, normal = n;
  }
}

void meet_shape(ShapeKind kind, const SearchRay& ray, SeenSpot& spot, glm::dvec3& normal) {
  if (kind == ShapeKind::sphere) {
    const double a = glm::dot(ray.direction, ray.direction), b = glm::dot(ray.origin, ray.direction),
                 c = glm::dot(ray.origin, ray.origin) - 1, square = b * b - a * c;
    if (square < 0) return;
    const double t = (-b - std::sqrt(square)) / a;
    if (t > 0 && t < spot.distance_m) spot.distance_m = t, normal = ray.origin + t * ray.direction;
    return;
  }
  int axis = 0;
  const auto t = enters_box(ray, {glm::dvec3(-1), glm::dvec3(1)}, axis);
  if (!t || !(*t > 0 && *t < spot.distance_m)) return;
  spot.distance_m = *t, normal = glm::dvec3(0), normal[axis] = 1;
}

// By small steps: some voxel, and the face through which the ray came to it.
void meet_voxels(const VoxelGrid& grid, const SearchRay& ray, SeenSpot& spot, glm::dvec3& normal) {
  constexpr double kStepsPerVoxel = 8;
  int axis = 0;
  const auto enters = enters_box(ray, {glm::dvec3(0), glm::dvec3(grid.counts)}, axis);
  if (!enters) return;
  const double step = 1 / (kStepsPerVoxel * glm::length(ray.direction));
  for (double t = std::max(*enters, 0.0) + 0.5 * step; t < spot.distance_m; t += step) {
    const glm::ivec3 voxel(glm::floor(ray.origin + t * ray.direction));
    if (glm::any(glm::lessThan(voxel, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(voxel, grid.counts)))
      return;
    if (grid.at(voxel) == 0) continue;
    const auto face = enters_box(ray, {glm::dvec3(voxel), glm::dvec3(voxel + 1)}, axis);
    spot.distance_m = face && *face > 0 ? *face : t;
    normal = glm::dvec3(0), normal[axis] = 1;
    return;
  }
}

// The first thing along the ray.
std::optional<SeenSpot> spot_along(const Scene& scene, const SearchRay& ray) {
  SeenSpot spot;
  for (const Instance& instance : scene.instances) {
    int axis = 0;
    const auto enters = enters_box(ray, instance_bounds(scene, instance), axis);
    if (!instance.present || !enters || *enters > spot.distance_m) continue;
    const glm::dmat4 back = glm::inverse(glm::dmat4(instance.world_from_object));
    const SearchRay local{glm::dvec3(back * glm::dvec4(ray.origin, 1)),
                          glm::dvec3(back * glm::dvec4(ray.direction, 0))};
    glm::dvec3 normal(0);
    if (instance.kind == ShapeKind::mesh) {
      meet_triangles(scene.meshes[instance.mesh], local, spot, normal);
    } else if (instance.kind == ShapeKind::voxels) {
      meet_voxels(scene.voxel_grids[instance.grid], local, spot, normal);
    } else {
      meet_shape(instance.kind, local, spot, normal);
    }
    if (normal == glm::dvec3(0)) continue;
    spot.normal = glm::normalize(glm::dvec3(glm::transpose(back) * glm::dvec4(normal, 0)));
    if (glm::dot(spot.normal, ray.direction) > 0) spot.normal = -spot.normal;
  }
  if (!std::isfinite(spot.distance_m)) return std::nullopt;
  spot.place = ray.origin + spot.distance_m * ray.direction;
  return spot;
}

// Looks where the left eye's gaze goes, then farther and farther around it, for a surface that is not seen
// at a grazing angle.
std::optional<SeenSpot> seen_spot(const RelationCase& subject) {
  const Pose world_from_eye = subject.scene.world_from_session * subject.sample.head.world_from_head *
                              subject.sample.head_from_eye[0];
  const glm::dvec3 gaze =
      subject.scene.world_from_session.orientation *
      (subject.sample.head.world_from_head.orientation * subject.sample.gaze.head_direction[0]);
  const glm::dvec3 right = world_from_eye.orientation * glm::dvec3(1, 0, 0);
  const glm::dvec3 up = world_from_eye.orientation * glm::dvec3(0, 1, 0);
  for (const double tangent : {0.0, 0.05, 0.1, 0.2, 0.35, 0.5}) {
    for (int turn = 0; turn < (tangent > 0 ? 8 : 1); ++turn) {
      const double angle = kPi / 4 * turn;
      const glm::dvec3 way =
          glm::normalize(gaze + tangent * (std::cos(angle) * right + std::sin(angle) * up));
      const auto spot = spot_along(subject.scene, {world_from_eye.position, way});
      if (spot && glm::dot(spot->normal, way) < -0.3) return spot;
    }
  }
  return std::nullopt;
}

// I = pi r^2 W/sr: white surfaces send back 1 at most.
AreaLight light_at(const glm::dvec3& centre, const glm::vec3& size) {
  AreaLight light;
  light.name = "near";
  light.centre = centre;
  light.size = size;
  const double r = 0.5 * double{std::max({size.x, size.y, size.z})};
  light.intensity_w_sr = glm::vec3(static_cast<float>(kPi * r * r));
  return light;
}

struct NearPlace {
  const char* name;
  AreaLight light;
};
std::array<NearPlace, 4> near_places(const SeenSpot& spot) {
  const double r = kRadiusOfDistance * spot.distance_m;
  const glm::vec3 cube(static_cast<float>(2 * r));
  glm::vec3 flat = cube;
  const glm::dvec3 n = glm::abs(spot.normal);
  flat[n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2] = 0;
  return {{{"just above a surface", light_at(spot.place + 1e-3 * r * spot.normal, cube)},
           {"on a surface", light_at(spot.place, cube)},
           {"inside a body", light_at(spot.place - r * spot.normal, cube)},
           {"in the plane of a surface", light_at(spot.place, flat)}}};
}

// One light in a white world.
RelationCase white_world(const RelationCase& subject) {
  RelationCase white = hard_light(subject);
  show_plainly(white);
  paint_all(white.scene, 1);
  take_catchers_away(white.scene);
  stop_emission(white.scene);
  make_environment_black(white.scene);
  white.scene.ambient = glm::vec3(0.0f);
  return white;
}

std::vector<LinearPicture> at_most_one(std::vector<LinearPicture> pictures) {
  for (LinearPicture& picture : pictures) limit_to_white(picture);
  return pictures;
}

}  // namespace

void measure_light_near(const RelationCase& subject, RelationLog& log) {
  Relation relation;
  relation.name = "light near a surface stays below I / r^2";
  relation.holds =
      "a light inside, on, 1e-3 of its radius above and in the plane of a white surface: nothing is brighter "
      "than 1 / pi * I / r^2, r half its longest edge, with 1 and 16 samples";
  relation.bound = 0x1p-10;
  relation.unit = "of I / (pi r^2), beyond it";
  relation.bound_from =
      "E = (I / N) sum V cos / max(d^2, r^2) <= I / r^2; sample and pixel are rounded to half floats";
  RelationCase white = white_world(subject);
  const auto spot = seen_spot(white);
  if (!spot) return log.not_applicable(relation, "no surface is seen around the gaze");
  double brightest = -1;
  std::string where;
  std::optional<RelationPictures> pictures;
  for (const int samples : {1, kNearLightSamples}) {
    white.settings.light_samples = samples;
    white.scene.lights = white.state.lights = {light_at(spot->place, glm::vec3(1))};
    const auto renderer = renderer_of(white);
    for (const NearPlace& near : near_places(*spot)) {
      white.state.lights = {near.light};
      const std::vector<LinearPicture> got = next_picture(*renderer, white), wanted = at_most_one(got);
      const double largest = largest_value(got);
      if (largest <= brightest) continue;
      brightest = largest;
      const PictureDistance beyond = largest_relative(got, wanted, 1, white.profile);
      where = std::string(near.name) + ", " + std::to_string(samples) +
              (samples == 1 ? " sample: " : " samples: ") + figure(brightest) + " of I / (pi r^2)" +
              (beyond.where.empty() ? "" : ", " + beyond.where);
      pictures = worst_pictures(beyond, got, wanted, "got | limited to I / (pi r^2) | difference");
    }
  }
  log.measured(relation, std::max(0.0, brightest - 1), where, std::move(pictures));
}

}  // namespace herr
