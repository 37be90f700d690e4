#include "server/study/study_subject.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "server/results/fingerprint.h"
#include "server/results/output_folder.h"
#include "server/study/error/acuity_filter.h"
#include "server/study/error/linear_picture.h"

namespace herr {
namespace {

constexpr int kQuickShare = 8;  // of a viewport's pixels per axis
constexpr int kQuickPolarWidth = 128, kQuickPolarHeight = 96;

// Renders frames small and quickly.
class QuickLook {
 public:
  QuickLook(const Scene& scene, const SessionReport& report, const RenderSettings& settings)
      : profile_(report.profile) {
    for (Viewport& v : profile_.viewports) {
      v.width_px = std::max(8, v.width_px / kQuickShare);
      v.height_px = std::max(8, v.height_px / kQuickShare);
    }
    RenderSettings quick = settings;
    quick.polar_width = kQuickPolarWidth, quick.polar_height = kQuickPolarHeight, quick.polar_acuity = false;
    quick.light_samples = 1, quick.adaptive_min_samples = 0, quick.occlusion_rays = 0;
    quick.probes.on = false;
    renderer_.emplace(scene, profile_, quick, report.findings.camera_rows[0] > 0);
  }

  // Standard deviation of luminance over what is seen, by the eye's acuity: what lies at the gaze counts
  // most.
  double contrast(const FrameStep& step) {
    renderer_->render_frame(step.sample(), step.scene_state(), frame_);
    const std::vector<ViewportMap> maps = viewport_maps(step.sample(), profile_);
    double weights = 0, sum = 0, squares = 0;
    LinearPicture picture;
    for (std::size_t v = 0; v < maps.size(); ++v) {
      read_viewport(frame_.viewports[v], picture);
      limit_to_white(picture);
      for (std::size_t i = 0; i < picture.pixels(); ++i) {
        if (maps[v].band[i] == kNotSeen) continue;
        const double weight =
            acuity_weight(double{maps[v].eccentricity_deg[i]}, double{maps[v].solid_angle_sr[i]});
        // Rec. 709.
        const double luminance = 0.2126 * double{picture.plane[0][i]} + 0.7152 * double{picture.plane[1][i]} +
                                 0.0722 * double{picture.plane[2][i]};
        weights += weight, sum += weight * luminance, squares += weight * luminance * luminance;
      }
    }
    if (!(weights > 0)) return 0;
    const double mean = sum / weights;
    return std::sqrt(std::max(0.0, squares / weights - mean * mean));
  }

 private:
  DisplayProfile profile_;
  std::optional<Renderer> renderer_;
  RenderedFrame frame_;
};

}  // namespace

StudySubject::StudySubject(const StudyOptions& options) {
  options_.sessions = {options.session};
  options_.scene = options.scene;
  options_.asset_roots = options.asset_roots;
  options_.profile = options.profile;
  options_.profile_scale = options.profile_scale;
  options_.render = options.render;
  options_.session = options.reading;
  report_.session_folder = options.session;
  report_.name = session_folder_name(options.session);
  open_session(options_, report_, opened_);
  step_.emplace(options_, report_, opened_);
  QuickLook look(opened_.scene, report_, report_.settings);
  frames_ = choose_frames(*step_, report_.range, options.frames,
                          [&](const FrameStep& step) { return look.contrast(step); });
  const Fingerprint fingerprint = fingerprint_of(report_, options_, opened_.scene);
  for (const auto& [name, value] : fingerprint.inputs) inputs_ += name + " " + value + "; ";
  for (const auto& [name, value] : fingerprint.settings) {
    if (name == "--profile" || name == "--profile-scale" || name == "--isa")
      inputs_ += name + " " + value + "; ";
  }
}

FrameInstant StudySubject::instant(std::int64_t frame) {
  step_->prepare(frame);
  FrameInstant instant;
  instant.number = frame;
  instant.scene = &opened_.scene;
  instant.state = &step_->scene_state();
  instant.sample = &step_->sample();
  instant.profile = &report_.profile;
  instant.session_has_camera = report_.findings.camera_rows[0] > 0;
  instant.maps = viewport_maps(step_->sample(), report_.profile);
  return instant;
}

FramePlan StudySubject::plan_of(const RenderSettings& settings) const {
  return plan_frame(opened_.scene, settings, report_.findings.camera_rows[0] > 0);
}

}  // namespace herr
