#include "server/study/relations/relation_case.h"

#include <utility>

#include "server/frames/resting_probes.h"

namespace herr {
namespace {

std::vector<LinearPicture> pictures_in(const RenderedFrame& frame) {
  std::vector<LinearPicture> out(frame.viewports.size());
  for (std::size_t i = 0; i < out.size(); ++i) read_viewport(frame.viewports[i], out[i]);
  return out;
}

}  // namespace

FramePlan plan_of(const RelationCase& subject) {
  return plan_frame(subject.scene, subject.settings, subject.camera);
}

std::unique_ptr<Renderer> renderer_of(const RelationCase& subject) {
  auto renderer =
      std::make_unique<Renderer>(subject.scene, subject.profile, subject.settings, subject.camera);
  let_probes_rest(*renderer, subject.sample, subject.state, subject.profile.display_hz);
  return renderer;
}

std::vector<LinearPicture> picture_of(const RelationCase& subject) {
  return next_picture(*renderer_of(subject), subject);
}

std::vector<LinearPicture> next_picture(Renderer& renderer, const RelationCase& subject) {
  RenderedFrame frame;
  renderer.render_frame(subject.sample, subject.state, frame);
  return pictures_in(frame);
}

std::vector<LinearPicture> picture_of_seed(Renderer& renderer, const RelationCase& subject,
                                           std::uint32_t seed) {
  RenderedFrame frame;
  PixelPass pass;
  pass.seed = seed;
  renderer.render_pass(subject.sample, subject.state, pass, frame);
  return pictures_in(frame);
}

RelationCase hard_light(RelationCase subject) {
  return soft_light(std::move(subject), 1);
}

RelationCase soft_light(RelationCase subject, int samples) {
  subject.camera = false;
  subject.settings.camera = false;
  subject.settings.light_samples = samples;
  subject.settings.adaptive_min_samples = 0;
  subject.settings.occlusion_rays = 0;
  subject.settings.probes.on = false;
  return subject;
}

RelationCase all_light(RelationCase subject) {
  subject = soft_light(std::move(subject), 4);
  subject.settings.occlusion_rays = 1;
  subject.settings.probes.on = true;
  return subject;
}

}  // namespace herr
