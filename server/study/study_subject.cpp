#include "server/study/study_subject.h"

#include "server/results/fingerprint.h"
#include "server/results/output_folder.h"

namespace herr {

StudySubject::StudySubject(const StudyOptions& options) {
  options_.sessions = {options.session};
  options_.scene = options.scene;
  options_.profile = options.profile;
  options_.render = options.render;
  options_.session = options.reading;
  report_.session_folder = options.session;
  report_.name = session_folder_name(options.session);
  open_session(options_, report_, opened_);
  step_.emplace(options_, report_, opened_);
  frames_ = choose_frames(*step_, report_.range, options.frames);
  const Fingerprint fingerprint = fingerprint_of(report_, options_, opened_.scene);
  for (const auto& [name, value] : fingerprint.inputs) inputs_ += name + " " + value + "; ";
  for (const auto& [name, value] : fingerprint.settings) {
    if (name == "--profile" || name == "--isa") inputs_ += name + " " + value + "; ";
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
