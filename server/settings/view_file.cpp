#include "server/settings/view_file.h"

#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>
#include <vector>

#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"
#include "sessions/text/written_order.h"

namespace herr {
namespace {

constexpr double kFarthestView_m = 1e9;
constexpr double kParallel_rad = 1e-6;  // between `up` and the direction of view
constexpr double kNearestFrusta_m = 1e-3, kFarthestFrusta_m = 1e6;

void read_name(const JsonObject& root, OutsideView& view) {
  view.name = root.text_or("name", view.name);
  const bool good = !view.name.empty() && view.name.size() <= 40 &&
                    view.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
  if (!good) {
    root.fail("name", "is '" + printable(view.name) + "'",
              "it becomes part of file names: use 1 to 40 of a-z, 0-9 and _");
  }
}

// +X of the camera to the right, +Z towards the viewer.
glm::dquat facing(const JsonObject& root, const glm::dvec3& position) {
  const auto vector = [&](const char* key) { return root.vec3(key, -kFarthestView_m, kFarthestView_m); };
  const glm::dvec3 towards = vector("look_at_m") - position;
  const double distance = glm::length(towards);
  if (!(distance > 0)) root.fail("look_at_m", "is position_m", "name a point that the camera looks at");
  const glm::dvec3 ahead = towards / distance;
  const glm::dvec3 up = root.has("up") ? vector("up") : glm::dvec3{0, 1, 0};
  const glm::dvec3 across = glm::cross(ahead, up);
  if (!(glm::length(across) > kParallel_rad * glm::length(up))) {
    root.fail(root.has("up") ? "up" : "look_at_m", "leaves open which way is up in the picture",
              "give an up that is not along the direction of view, for example [0, 0, -1]");
  }
  const glm::dvec3 right = glm::normalize(across);
  return glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(right, ahead), -ahead)));
}

glm::dquat turned(const JsonObject& root, std::vector<std::string>& warnings) {
  if (root.has("up")) root.fail("up", "belongs to look_at_m", "leave it out beside orientation_xyzw");
  const std::array<double, 4> q = root.unit_quaternion("orientation_xyzw");
  if (const auto doubt = order_doubt(q)) {
    const char* kField = "orientation_xyzw";
    warnings.emplace_back(InputError(root.file(), line_of_field(root.file(), kField),
                                     std::string("field ") + kField + " " + doubt->problem, doubt->remedy)
                              .what());
  }
  return glm::normalize(glm::dquat(q[3], q[0], q[1], q[2]));
}

void read_pose(const JsonObject& root, OutsideView& view, std::vector<std::string>& warnings) {
  const std::string space = root.text_or("space", "scene");
  if (space != "scene" && space != "session")
    root.fail("space", "is '" + printable(space) + "'", "write scene or session");
  view.space = space == "scene" ? OutsideSpace::scene : OutsideSpace::session;
  view.space_from_camera.position = root.vec3("position_m", -kFarthestView_m, kFarthestView_m);
  if (root.has("look_at_m") == root.has("orientation_xyzw")) {
    root.fail(
        root.has("orientation_xyzw") ? "orientation_xyzw" : "look_at_m",
        root.has("orientation_xyzw") ? "stands beside look_at_m" : "is missing, and so is orientation_xyzw",
        "give one of the two: look_at_m [x, y, z], or orientation_xyzw [qx, qy, qz, qw]");
  }
  view.space_from_camera.orientation =
      root.has("orientation_xyzw") ? turned(root, warnings) : facing(root, view.space_from_camera.position);
}

void read_picture(const JsonObject& root, OutsideView& view) {
  view.fov_deg = root.number_or("fov_deg", kNarrowestOutside_deg, kWidestOutside_deg, view.fov_deg);
  const auto pixels = [&](const char* key, int usual) {
    return static_cast<int>(root.integer_or(key, 1, kMostOutsideSide_px, usual));
  };
  view.width_px = pixels("width_px", view.width_px);
  view.height_px = pixels("height_px", view.height_px);
  view.samples = static_cast<int>(root.integer_or("samples", 1, kMostOutsideSamples, view.samples));
  const std::int64_t rays = std::int64_t{view.width_px} * view.height_px * view.samples * view.samples;
  if (rays > kMostOutsideRays) {
    root.fail("samples", "asks for " + std::to_string(rays) + " rays in one picture",
              "keep width_px x height_px x samples x samples to " + std::to_string(kMostOutsideRays));
  }
  if (root.has("see_through_colour")) {
    try {
      view.see_through = shown_colour_from(root.text("see_through_colour"));
    } catch (const std::invalid_argument& error) {
      root.fail("see_through_colour", error.what(), "or leave it out: it is pink");
    }
  }
  view.overlay = root.boolean_or("overlay", view.overlay);
  view.frusta_m = root.number_or("frusta_m", kNearestFrusta_m, kFarthestFrusta_m, view.frusta_m);
}

}  // namespace

OutsideView load_view_file(const std::filesystem::path& file, std::vector<std::string>& warnings) {
  const JsonDocument document(file);
  const JsonObject root = document.root();
  root.allow_only({"name", "space", "position_m", "look_at_m", "up", "orientation_xyzw", "fov_deg",
                   "width_px", "height_px", "samples", "see_through_colour", "overlay", "frusta_m"});
  OutsideView view;
  read_name(root, view);
  read_pose(root, view, warnings);
  read_picture(root, view);
  return view;
}

std::string view_text(const OutsideView& view) {
  const Pose& pose = view.space_from_camera;
  std::string text = view.name + (view.space == OutsideSpace::scene ? " scene " : " session ") +
                     std::to_string(view.width_px) + 'x' + std::to_string(view.height_px) + " samples " +
                     std::to_string(view.samples) + (view.overlay ? " overlay" : "") + " see-through " +
                     (view.see_through ? text_of(*view.see_through) : "as set");
  for (const double value :
       {pose.position.x, pose.position.y, pose.position.z, pose.orientation.x, pose.orientation.y,
        pose.orientation.z, pose.orientation.w, view.fov_deg, view.frusta_m}) {
    text += ' ' + shortest_text(value + 0.0);  // -0 is 0
  }
  return text;
}

}  // namespace herr
