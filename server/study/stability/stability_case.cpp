#include "server/study/stability/stability_case.h"

#include <algorithm>

namespace herr {
namespace {

// Of the pixels per axis: many pictures are made.
constexpr int kProfileShare = 8, kPolarShare = 4;
constexpr int kFewestPixels = 16;

DisplayProfile smaller(DisplayProfile profile) {
  for (Viewport& viewport : profile.viewports) {
    viewport.width_px =
        std::min(viewport.width_px, std::max(kFewestPixels, viewport.width_px / kProfileShare));
    viewport.height_px =
        std::min(viewport.height_px, std::max(kFewestPixels, viewport.height_px / kProfileShare));
  }
  return profile;
}

RenderSettings smaller(RenderSettings settings) {
  settings.polar_width = std::max(1, settings.polar_width / kPolarShare);
  settings.polar_height = std::max(2, settings.polar_height / kPolarShare / 2 * 2);
  return settings;
}

StudyOptions of_one_frame(StudyOptions options) {
  options.frames = 1;
  return options;
}

}  // namespace

StabilityCase::StabilityCase(const StudyOptions& options) : subject_(of_one_frame(options)) {
  const FrameInstant instant = subject_.instant(frame().number);
  case_.scene = *instant.scene;
  case_.scene.changes = false;
  case_.state = *instant.state;
  case_.sample = *instant.sample;
  case_.profile = smaller(*instant.profile);
  case_.settings = smaller(subject_.defaults());
  case_.camera = instant.session_has_camera;
}

}  // namespace herr
