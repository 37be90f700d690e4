// What `herr look` is asked to show. Before: the command line. After: look_command.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/render_settings.h"
#include "server/settings/picture_formats.h"

namespace herr {

inline constexpr int kMostLookSide_px = 16384, kMostTurntable = 10000, kMostLookSamples = 1024;

// Where the camera stands, seen from the middle of the model. glTF models look along +Z: at azimuth 0 the
// camera stands there and sees the front; azimuths grow counter-clockwise as seen from above (90: from +X).
// Elevation 90: from straight above, +Z being below in the picture.
struct LookDirection {
  double azimuth_deg = 30, elevation_deg = 15;
};

struct LookOptions {
  std::filesystem::path path;                      // .gltf, .glb, .vox or .scene.json
  std::vector<std::filesystem::path> asset_roots;  // folders below which a scene document finds models, too
  std::filesystem::path out;  // empty: the model's name with .png, or as a folder of a turntable, here
  std::optional<PictureFormats>
      formats;  // none: by the ending of `out`; without one, and of a turntable, PNG
  bool overwrite = false;
  int width_px = 800, height_px = 800;
  double fov_deg = 35;  // across the shorter side of the picture
  LookDirection from;
  double distance = 1;      // of the camera, in multiples of the one from which the model fills the picture
  int turntable = 0;        // pictures evenly around, in a new folder; 0: one picture
  double time_s = 0;        // of animations, paths and the document's timeline
  int samples = 4;          // rays per pixel
  bool background = true;   // the environment behind the model; else transparent
  std::string environment;  // picture of the light around; empty: the scene's own
  bool automatic_exposure = false;  // asked for, whatever the scene says
  RenderSettings render;            // light, rays, probes, exposure (none: automatic) and the machine
  bool json = false;                // results on stdout as JSON
};

// What no single flag can know. Throws UsageError.
void check_look_options(const LookOptions& options);

}  // namespace herr
