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
  settings.polar_acuity = false;
  return settings;
}

StudyOptions of_one_frame(StudyOptions options) {
  options.frames = 1;
  return options;
}

bool is_of_one_colour(const LinearPicture& picture) {
  return std::all_of(picture.plane.begin(), picture.plane.end(), [](const std::vector<float>& plane) {
    return std::all_of(plane.begin(), plane.end(), [&](float value) { return value == plane.front(); });
  });
}

}  // namespace

StabilityCase::StabilityCase(const StudyOptions& options) : subject_(of_one_frame(options)) {
  subject_.free_renderer();
  const FrameInstant instant = subject_.instant(frame().number);
  case_.scene = *instant.scene;
  case_.scene.changes = false;
  case_.state = *instant.state;
  case_.sample = *instant.sample;
  case_.profile = smaller(*instant.profile);
  case_.settings = smaller(subject_.defaults());
  case_.camera = instant.session_has_camera;
  case_.session = options.session;
  case_.reading = options.reading;
}

std::vector<std::string> StabilityCase::warnings() const {
  std::vector<std::string> all = report().warnings;
  all.insert(all.end(), case_.scene.warnings.begin(), case_.scene.warnings.end());
  const std::vector<LinearPicture> pictures = picture_of(hard_light(case_));
  if (std::all_of(pictures.begin(), pictures.end(), is_of_one_colour)) {
    all.emplace_back(
        "the frame shows one colour everywhere, of which most relations hold whatever the renderer does; "
        "give a scene with lights that stands in the session's view");
  }
  return all;
}

}  // namespace herr
