#include "server/inspect/scene_text.h"

#include <algorithm>

#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

constexpr std::size_t kObjectsShown = 12;

std::string megabytes(std::int64_t bytes) {
  return fixed_text(static_cast<double>(bytes) * 1e-6, 1) + " MB";
}

std::string point(const glm::dvec3& p) {
  return "(" + fixed_text(p.x, 2) + ", " + fixed_text(p.y, 2) + ", " + fixed_text(p.z, 2) + ")";
}

std::string view_cells(const SceneObject& object) {
  if (!object.in_view) return "";
  const auto percent = [](double share) { return right_aligned(fixed_text(100 * share, 0) + " %", 10); };
  std::string text = percent(*object.in_view) + percent(object.middle_in_view.value_or(0));
  if (object.most_central_s)
    text += "   at " + fixed_text(*object.most_central_s, 1) + " s: --start " +
            shortest_text(*object.most_central_s);
  return text;
}

std::string objects_text(const SceneFacts& scene) {
  std::string text;
  for (std::size_t i = 0; i < std::min(scene.objects.size(), kObjectsShown); ++i) {
    const SceneObject& object = scene.objects[i];
    text += "  " + left_aligned(object.name.empty() ? "(no name)" : printable(object.name), 30) +
            right_aligned(std::to_string(object.instances), 8) +
            right_aligned(std::to_string(object.triangles), 12) + view_cells(object) +
            (object.catcher ? "  catcher" : "") + "\n";
  }
  if (scene.objects.size() > kObjectsShown)
    text += "  and " + std::to_string(scene.objects.size() - kObjectsShown) + " more\n";
  const bool in_view = std::any_of(scene.objects.begin(), scene.objects.end(),
                                   [](const SceneObject& object) { return object.in_view.has_value(); });
  const std::string head =
      "  " + left_aligned("object", 30) + right_aligned("parts", 8) + right_aligned("triangles", 12) +
      (in_view ? right_aligned("in view", 10) + right_aligned("middle", 10) + "   most central" : "") + "\n";
  return text.empty() ? "" : head + text;
}

// Where the recording should stand, if it looks past the scene.
std::string in_view_text(const InspectReport& report) {
  if (!report.in_view) return "";
  std::string text =
      "  in view: of the recorded poses, by the object's box at the start; what hides it is not looked at;\n"
      "  middle: of the poses, those with the box's middle in view\n";
  if (!report.in_view->proposal) return text;
  return text + "  the head looks past it: its middle is in view in " +
         fixed_text(100 * report.in_view->subject_share, 0) +
         " % of the poses; to turn the recording towards it, write into the scene document\n    " +
         world_from_session_text(*report.in_view->proposal) + "\n";
}

std::string grids_text(const SceneFacts& scene) {
  if (scene.grids.empty()) return "";
  std::string text =
      named_line("voxels", counted(static_cast<std::int64_t>(scene.grids.size()), "grid", "grids") + ", " +
                               megabytes(scene.voxel_bytes) + " (octrees come on top)");
  for (std::size_t i = 0; i < std::min(scene.grids.size(), kObjectsShown); ++i) {
    const GridFacts& grid = scene.grids[i];
    text += named_line("", printable(grid.name) + ": " + std::to_string(grid.counts.x) + " x " +
                               std::to_string(grid.counts.y) + " x " + std::to_string(grid.counts.z) + ", " +
                               counted(grid.voxels, "voxel", "voxels") + ", " + megabytes(grid.bytes));
  }
  if (scene.grids.size() > kObjectsShown)
    text += named_line("", "and " + std::to_string(scene.grids.size() - kObjectsShown) + " more");
  return text;
}

}  // namespace

std::string named_line(const std::string& name, const std::string& value) {
  return "  " + left_aligned(name, 12) + value + "\n";
}

std::string scene_text(const InspectReport& report) {
  const SceneFacts& scene = *report.scene;
  std::string text =
      "scene " + printable(scene.name) + "   (" + printable(report.scene_file.string()) + ")\n";
  text += named_line("triangles", std::to_string(scene.triangles) + " in " +
                                      counted(scene.instances - scene.catchers, "instance", "instances") +
                                      ", and " + std::to_string(scene.catcher_triangles) + " in " +
                                      counted(scene.catchers, "catcher", "catchers") + "; " +
                                      std::to_string(scene.degenerate_triangles) + " without area");
  text +=
      named_line("stored", counted(scene.stored_triangles, "triangle", "triangles") + " in " +
                               counted(scene.meshes, "mesh", "meshes") + ", " +
                               megabytes(scene.geometry_bytes) + " (acceleration structures come on top)");
  text += grids_text(scene);
  if (scene.spheres + scene.boxes > 0)
    text += named_line("shapes", counted(scene.spheres, "sphere", "spheres") + ", " +
                                     counted(scene.boxes, "box", "boxes") + ", met analytically");
  text += named_line("materials", std::to_string(scene.materials) + ", " + std::to_string(scene.mirrors) +
                                      (scene.mirrors == 1 ? " reflects, " : " reflect, ") +
                                      std::to_string(scene.emitters) +
                                      (scene.emitters == 1 ? " emits light" : " emit light"));
  text += named_line("textures", std::to_string(scene.textures) + ", " +
                                     fixed_text(static_cast<double>(scene.texture_pixels) * 1e-6, 2) +
                                     " Mpx, " + megabytes(scene.texture_bytes));
  text +=
      named_line("lights", std::to_string(scene.lights) + ", " + std::to_string(scene.moving_lights) +
                               " on a path, " + std::to_string(scene.virtual_lights) + " virtual; ambient " +
                               point(scene.ambient) + ", environment " + point(scene.environment));
  if (scene.exposure) {
    text += named_line("exposure", scene.exposure->automatic ? "by the first frame of the session"
                                                             : shortest_text(scene.exposure->ev) + " EV");
  }
  if (scene.moving_objects > 0)
    text += named_line("paths", counted(scene.moving_objects, "object follows a path of its own",
                                        "objects follow paths of their own"));
  text += named_line(
      "bounds", point(scene.bounds.lower) + " to " + point(scene.bounds.upper) + " m" +
                    (scene.catchers > 0 && scene.catchers < scene.instances ? ", without catchers" : ""));
  text += named_line("files", std::to_string(scene.files.size()));
  return text + objects_text(scene) + in_view_text(report) + "\n";
}

}  // namespace herr
