#include "server/look/look_command.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <utility>

#include "scenes/changes/bounding_sphere.h"
#include "scenes/changes/world.h"
#include "scenes/load_scene.h"
#include "server/frames/warnings/picture_warnings.h"
#include "server/look/look_encoding.h"
#include "server/look/look_files.h"
#include "server/look/look_light.h"
#include "server/look/look_picture.h"
#include "server/look/look_report.h"
#include "server/output/new_folder.h"
#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/settings/option_checks.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr double kFarthestCamera_m = 9e8;  // where a head may be

// A session has its scene, but look shows no session.
void refuse_folder(const std::filesystem::path& path) {
  const bool header = path.filename() == "session.json";
  if (!header && !is_folder(path)) return;
  const std::string name = printable(path.string());
  if (header || path_exists(path / "session.json"))
    throw UsageError("MODEL: '" + name + "' is a session; use `herr replay`, or name its scene");
  throw UsageError("MODEL: '" + name + "' is a folder; name a .gltf, .glb, .vox or .scene.json file");
}

// What is looked at: the scene at its time, lit.
struct Subject {
  Scene scene;
  std::optional<World> world;
  SceneState state;
  BoundingSphere sphere;
  std::vector<std::string> beyond;  // names of floors and walls that the picture does not hold whole
  bool studio = false;
};

void load(const LookOptions& options, Subject& subject) {
  Scene& scene = subject.scene;
  scene = load_scene(options.path, TexturePixels::decoded, DefaultLight::none, options.asset_roots);
  subject.studio = needs_studio(scene, !is_scene_document(options.path));
  if (!options.environment.empty()) {
    add_environment(options, subject.studio, scene);
  } else if (subject.studio) {
    light_studio(options.from.azimuth_deg, scene);
  }
  for (std::string& warning :
       picture_warnings(scene, options.path, plan_frame(scene, options.render, false), options.render))
    scene.warnings.push_back(std::move(warning));
  for (const std::string& warning : scene.warnings) print_message("warning: " + warning);
  subject.world.emplace(scene);
  subject.world->advance(options.time_s);
  subject.state = subject.world->state();
  FramedSphere framed = framed_sphere(scene, subject.state);
  subject.sphere = framed.sphere;
  subject.beyond = std::move(framed.left_out);
  if (!(subject.sphere.radius > 0))
    throw InputError(options.path, 0, "has nothing to look at: no triangles, shapes or voxels",
                     "export the model with its meshes");
}

LookDirection direction_of(const LookOptions& options, int number) {
  LookDirection from = options.from;
  if (options.turntable > 0) from.azimuth_deg += 360.0 * number / options.turntable;
  return from;
}

LookCamera camera_of(const LookOptions& options, const Subject& subject, const LookDirection& from) {
  const LookCamera camera = look_camera(options, from, subject.sphere);
  if (!(glm::length(camera.world_from_camera.position) < kFarthestCamera_m))
    throw InputError(options.path, 0,
                     "is so large or so far out that the camera would stand farther than 9e8 m",
                     "check its units and scales");
  return camera;
}

// A folder of pictures of an earlier turntable, and nothing else.
void check_turntable_folder(const std::filesystem::path& folder) {
  std::error_code error;
  for (const std::string& name : list_folder(folder, error)) {
    if (is_turntable_picture(name)) continue;
    throw UsageError("--out: " + printable((folder / name).string()) +
                     " is no picture of a turntable and would be lost; choose another folder");
  }
  if (error)
    throw UsageError("--out: cannot look into " + printable(folder.string()) + ": " + error.message() +
                     "; choose another folder");
}

class LookRun {
 public:
  explicit LookRun(const LookOptions& options) : options_(options), files_(look_files(options)) {
    if (options.turntable > 0) {
      folder_.emplace(NewFolder::Request{files_.folder, options.overwrite, "--out", "helmet-turntable",
                                         check_turntable_folder});
    }
  }

  int run() {
    load(options_, subject_);
    report_.from = direction_of(options_, 0);
    const LookCamera first = camera_of(options_, subject_, report_.from);
    report_.distance_m = first.distance;
    LookRenderer renderer(subject_.scene, options_, first);
    report_.pictures = std::max(1, options_.turntable);
    for (int number = 0; number < report_.pictures; ++number) {
      const LookDirection from = direction_of(options_, number);
      const LookCamera camera = camera_of(options_, subject_, from);
      Look look;
      if (!renderer.render(camera, lit_for(from), backdrop(), look)) return stopped();
      write(renderer, camera, look, number);
    }
    if (folder_) folder_->keep();
    print();
    return kExitDone;
  }

 private:
  bool in_room() const { return subject_.studio && options_.environment.empty(); }

  // The studio turns with the camera.
  const SceneState& lit_for(const LookDirection& from) {
    if (in_room()) {
      light_studio(from.azimuth_deg, subject_.scene);
      subject_.state.lights = subject_.scene.lights;
    }
    return subject_.state;
  }
  std::optional<glm::vec3> backdrop() const {
    return in_room() ? std::optional(glm::vec3(kStudioBackdrop)) : std::nullopt;
  }

  // All pictures of a turntable are shown as the first one is.
  void write(LookRenderer& renderer, const LookCamera& camera, Look& look, int number) {
    if (number == 0) report_.exposure = look_exposure(options_, subject_.scene, in_room(), look.model);
    look.picture.exposure = report_.exposure.scale();
    std::size_t file = 0;
    for (const PictureFormat format : kPictureFormats) {
      if (!files_.formats.has(format)) continue;
      const std::vector<std::uint8_t> bytes = encoded_look(options_, renderer, camera, look.picture, format);
      write_whole_file(
          folder_ ? folder_->path() / turntable_picture(options_, number, format) : files_.files.at(file++),
          bytes);
    }
  }

  void print() {
    report_.out = folder_ ? files_.folder : files_.files.front();
    if (!folder_) report_.also.assign(files_.files.begin() + 1, files_.files.end());
    report_.width_px = options_.width_px;
    report_.height_px = options_.height_px;
    report_.fov_deg = options_.fov_deg;
    report_.light = in_room()         ? "studio light"
                    : subject_.studio ? "light of the environment"
                                      : "its own light";
    report_.beyond = subject_.beyond;
    report_.triangles = triangle_count(subject_.scene, false);
    report_.warnings = subject_.scene.warnings;
    print_result(options_.json ? look_json(report_) : look_text(report_));
  }

  static int stopped() {
    print_message("stopped: nothing was written");
    return kExitSignalBase + stop_signal();
  }

  const LookOptions& options_;
  const LookFiles files_;
  std::optional<NewFolder> folder_;
  Subject subject_;
  LookReport report_;
};

}  // namespace

void check_look_options(const LookOptions& options) {
  if (options.path.empty()) throw UsageError("MODEL: the path is empty; give a file");
  if (options.turntable > 0 && options.out.has_extension() &&
      (options.out.extension() == ".png" || options.out.extension() == ".exr"))
    throw UsageError("--out: of --turntable it is a folder; leave the ending out");
  constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;  // floats of a picture: a gigabyte
  if (std::int64_t{options.width_px} * options.height_px > kMostPixels)
    throw UsageError("--size: has more than 67108864 pixels; give at most 8192x8192");
}

int run_look(const LookOptions& options) {
  if (const int signal = stop_signal(); signal != 0) return kExitSignalBase + signal;
  check_render_settings(options.render);
  refuse_folder(options.path);
  return LookRun(options).run();
}

}  // namespace herr
