#include "server/study/relations/place/similar_case.h"

#include <stdexcept>
#include <utility>

#include "renderer/settings_list.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr double kFarthestHead_m = 1e9;  // of a head in its session, as the renderer takes it

void scale_sample(FrameSample& sample, double scale) {
  sample.head.world_from_head.position *= scale;
  for (Pose& eye : sample.head_from_eye) eye.position *= scale;
  for (auto& camera : sample.cameras) {
    if (camera) camera->world_from_camera.position *= scale;
  }
}

RenderSettings scaled_settings(RenderSettings settings, double scale) {
  settings.occlusion_radius_m *= scale;
  settings.feed_distance_m = scale * settings.feed_distance_m.value_or(kUsualFeedDistance_m);
  return settings;
}

}  // namespace

RelationCase similar_case(RelationCase subject, const Similarity& similarity) {
  subject.scene = similar_scene(std::move(subject.scene), similarity);
  for (AreaLight& light : subject.state.lights) light = similar_light(std::move(light), similarity);
  scale_sample(subject.sample, similarity.scale);
  subject.settings = scaled_settings(std::move(subject.settings), similarity.scale);
  return subject;
}

std::string why_not_similar(const RelationCase& subject, const Similarity& similarity) {
  std::string why = why_not_similar(subject.scene, similarity);
  if (!why.empty()) return why;
  const glm::dvec3 head = similarity.scale * subject.sample.head.world_from_head.position;
  if (!(glm::length(head) < kFarthestHead_m))
    return "the head then stands beyond 1e9 m of its session's origin";
  try {
    check_settings(scaled_settings(subject.settings, similarity.scale));
  } catch (const std::invalid_argument& error) {
    return std::string("then ") + error.what();
  }
  return {};
}

}  // namespace herr
