#include "server/inspect/probes/probe_dump.h"

#include <cmath>
#include <system_error>

#include "renderer/renderer.h"
#include "server/inspect/probes/probe_atlas.h"
#include "server/inspect/probes/probe_index.h"
#include "server/output/float_exr.h"
#include "server/output/png_encoder.h"
#include "server/process/exit_code.h"
#include "server/process/progress_bar.h"
#include "server/process/stop_signal.h"
#include "server/text/number_text.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIndexName = "probes.json";

bool is_dump_file(const std::string& name) {
  if (name == kIndexName) return true;
  for (const char* set : {"", "catchers_"}) {
    for (const char* quantity : {"irradiance", "distance"}) {
      for (const char* extension : {".exr", ".png"})
        if (name == std::string(set) + quantity + extension) return true;
    }
  }
  return false;
}

void check_overwritable(const fs::path& folder) {
  std::error_code error;
  for (const std::string& name : list_folder(folder, error)) {
    if (is_dump_file(name)) continue;
    throw UsageError("--probe-pictures: " + printable((folder / name).string()) +
                     " is no picture of probes and would be lost; move it away or choose another folder");
  }
  if (error)
    throw UsageError("--probe-pictures: cannot look into " + printable(folder.string()) + ": " +
                     error.message() + "; choose another folder");
}

// No frame is rendered: the smallest view will do.
DisplayProfile smallest_view() {
  DisplayProfile profile;
  profile.name = "probes";
  Viewport view;
  view.name = "probes";
  view.width_px = view.height_px = 1;
  view.tan_left = view.tan_down = -1;
  view.tan_right = view.tan_up = 1;
  profile.viewports = {view};
  return profile;
}

// False: a signal asked for the end.
bool settle(Renderer& renderer, const ProbeScene& from, int updates) {
  const ProbeGrid& grid = renderer.probes()->grid();
  FrameSample sample;
  const glm::dvec3 middle = grid.lower + 0.5 * glm::dvec3(grid.counts) * grid.spacing;
  Pose world_from_grid;
  world_from_grid.position = middle;
  sample.head.world_from_head = inverse(from.scene.world_from_session) * world_from_grid;
  SceneState state;
  scene_state_at(from.scene, 0.0, state);
  ProgressBar bar("probes", updates);
  for (int i = 0; i < updates; ++i) {
    if (stop_signal() != 0) return false;
    sample.t_ns = static_cast<TimeNs>(std::llround(1e9 * i / from.display_hz));
    renderer.skip_frame(sample, state);
    bar.update(i + 1);
  }
  return true;
}

void count_states(const ProbeReader& probes, ProbeDump& dump) {
  for (int probe = 0; probe < probes.grid().size(); ++probe) {
    if (probes.relocated(probe)) ++dump.relocated;
    switch (probes.state(probe)) {
      case ProbeState::active:
        ++dump.active;
        break;
      case ProbeState::dark:
        ++dump.dark;
        break;
      case ProbeState::far:
        ++dump.far;
        break;
    }
  }
  dump.probes = probes.grid().size();
  dump.rays = probes.rays();
  dump.variability = probes.variability();
}

AtlasFiles write_atlas(const FloatPlanes& atlas, const AtlasPicture& picture, const std::string& name,
                       const fs::path& folder, ProbeDump& dump) {
  std::vector<std::uint8_t> bytes;
  encode_float_exr(atlas, bytes);
  write_whole_file(folder / (name + ".exr"), bytes);
  encode_png(picture.image, bytes);
  write_whole_file(folder / (name + ".png"), bytes);
  dump.files.push_back({name + ".exr", "float values", atlas.width_px, atlas.height_px});
  dump.files.push_back({name + ".png", "for the eye", picture.image.width_px, picture.image.height_px});
  return {"", "", name + ".exr", name + ".png", picture.white, picture.enlarge};
}

std::vector<AtlasFiles> write_atlases(const ProbeReader& probes, const AtlasLayout& layout,
                                      const fs::path& folder, ProbeDump& dump) {
  std::vector<AtlasFiles> written;
  for (int set = 0; set < probes.sets(); ++set) {
    const std::string prefix = set == 0 ? "" : "catchers_";
    const auto add = [&](AtlasFiles files, const char* quantity) {
      files.set = set == 0 ? "all" : "catchers";
      files.quantity = quantity;
      written.push_back(std::move(files));
    };
    const FloatPlanes light = irradiance_atlas(probes, set, layout);
    add(write_atlas(light, irradiance_picture(light, probes, layout), prefix + "irradiance", folder, dump),
        "irradiance");
    const FloatPlanes sight = distance_atlas(probes, set, layout);
    add(write_atlas(sight, distance_picture(sight, probes, layout), prefix + "distance", folder, dump),
        "distance");
  }
  return written;
}

}  // namespace

std::unique_ptr<NewFolder> probe_folder(const ProbeDumpRequest& request) {
  return std::make_unique<NewFolder>(NewFolder::Request{request.folder, request.overwrite, "--probe-pictures",
                                                        "out/probes", check_overwritable});
}

std::optional<ProbeDump> dump_probes(const ProbeScene& from, const ProbeDumpRequest& request,
                                     NewFolder& folder) {
  RenderSettings settings = from.settings;
  settings.probes.on = true;
  settings.foveation = Foveation::off;
  if (!plan_frame(from.scene, settings, from.session_has_camera).probes)
    throw InputError(from.file, 0, "has no surface, so no probes run", "give a scene that has some");
  Renderer renderer(from.scene, smallest_view(), settings, from.session_has_camera);
  if (!settle(renderer, from, request.updates)) return std::nullopt;

  const ProbeReader probes = *renderer.probes();
  ProbeDump dump;
  dump.folder = folder.final_path();
  dump.updates = request.updates;
  dump.display_hz = from.display_hz;
  count_states(probes, dump);
  const AtlasLayout layout = lay_out_probes(probes.grid());
  const std::vector<AtlasFiles> atlases = write_atlases(probes, layout, folder.path(), dump);
  write_whole_file(folder.path() / kIndexName, probe_index_text(probes, layout, atlases, from, dump));
  dump.files.push_back({kIndexName, "layout, places, states", 0, 0});
  sync_folder(folder.path());
  if (stop_signal() != 0) return std::nullopt;
  folder.keep();
  return dump;
}

std::string probe_dump_text(const ProbeDump& dump) {
  std::string text = "probes in " + printable(dump.folder.string()) + "\n  " +
                     counted(dump.probes, "probe", "probes") + ": " + std::to_string(dump.active) +
                     " active, " + std::to_string(dump.dark) + " dark, " + std::to_string(dump.far) +
                     " far from every surface; " + std::to_string(dump.relocated) + " relocated\n  after " +
                     counted(dump.updates, "update", "updates") + " at " + shortest_text(dump.display_hz) +
                     " Hz of " + counted(dump.rays, "ray", "rays") + " each, lights held; variability " +
                     fixed_text(dump.variability, 4) + "\n";
  for (const ProbeDump::File& file : dump.files) {
    text += "  " + left_aligned(file.name, 26) + left_aligned(file.what, 24);
    if (file.width_px > 0) text += std::to_string(file.width_px) + "x" + std::to_string(file.height_px);
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  return text + "\n";
}

}  // namespace herr
