// `herr inspect --probe-pictures DIR`: lets the probes of a scene gather light, and writes what they know as
// pictures with an index, for people and other programs. Before: inspect has found the input sound. After:
// DIR stands whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/render_settings.h"
#include "scenes/model/scene.h"
#include "server/output/new_folder.h"

namespace herr {

class ProbeReader;

inline constexpr int kDefaultProbeUpdates = 256;  // 4.3 s at 60 Hz: what is missing shrinks as e^-11.7

struct ProbeDumpRequest {
  std::filesystem::path folder;
  bool overwrite = false;
  int updates = kDefaultProbeUpdates;
};

struct ProbeDump {
  struct File {
    std::string name, what;
    int width_px = 0, height_px = 0;
  };
  std::filesystem::path folder;
  std::vector<File> files;
  int updates = 0, rays = 0, probes = 0;
  std::int64_t active = 0, relocated = 0, dark = 0, far = 0;
  double variability = 0, display_hz = 0;
};

// The folder is checked at once, before anything costs time. Throws UsageError.
std::unique_ptr<NewFolder> probe_folder(const ProbeDumpRequest& request);

// Holds lights where they are at the session's start and updates all probes `updates` times, one display
// period apart: the same input gives the same bytes. Throws InputError when the scene has nothing to gather
// light for, WriteError. None: a signal asked for the end, and nothing was kept.
struct ProbeScene {
  const Scene& scene;
  std::filesystem::path file;
  const RenderSettings& settings;
  bool session_has_camera = false;
  double display_hz = 60;
};
std::optional<ProbeDump> dump_probes(const ProbeScene& from, const ProbeDumpRequest& request,
                                     NewFolder& folder);

// The lines of the report for people.
std::string probe_dump_text(const ProbeDump& dump);

}  // namespace herr
