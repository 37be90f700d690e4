#include "server/inspect/scene_in_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <map>

#include "scenes/changes/bounding_sphere.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr std::size_t kMostPoses = 512;  // of 4096 that are kept: shares to 0.2 %
constexpr double kSmallest = 0.035;      // tangent of 2 degrees, half of how large it should look
const double kSteepest = std::tan(glm::radians(20.0)), kHalfWidth = std::sin(glm::radians(20.0));
constexpr double kClear_m = 0.3;  // between head and sphere

std::vector<Pose> thinned(const std::vector<Pose>& poses) {
  std::vector<Pose> few;
  const std::size_t step = (poses.size() + kMostPoses - 1) / kMostPoses;
  for (std::size_t i = 0; i < poses.size(); i += step) few.push_back(poses[i]);
  return few;
}

glm::dvec3 level(const glm::dvec3& v) {
  return {v.x, 0, v.z};
}

// What poses have of an object before them; its parts as facts_of() groups them.
struct ObjectViews {
  std::vector<Bounds> parts;
  Bounds middle;  // of the box about all parts
  int seen = 0, middle_seen = 0;
  double least_rad = 4;  // between straight ahead and the middle, of poses that have it in view
  Pose most_central;     // session_from_head
};

std::map<std::string, ObjectViews> objects_by_name(const Scene& scene) {
  std::map<std::string, ObjectViews> objects;
  for (const Instance& instance : scene.instances) {
    if (instance.catcher || !instance.present) continue;
    objects[instance.name.substr(0, instance.name.find('/'))].parts.push_back(
        instance_bounds(scene, instance));
  }
  for (auto& [name, object] : objects) {
    Bounds whole = object.parts.front();
    for (const Bounds& part : object.parts)
      whole = {glm::min(whole.lower, part.lower), glm::max(whole.upper, part.upper)};
    object.middle.lower = object.middle.upper = 0.5 * (whole.lower + whole.upper);
  }
  return objects;
}

void look(const Pose& session_from_head, const Pose& head, const ViewBorders& borders, ObjectViews& object) {
  object.seen += std::any_of(object.parts.begin(), object.parts.end(),
                             [&](const Bounds& box) { return in_view(box, head, borders); })
                     ? 1
                     : 0;
  if (!in_view(object.middle, head, borders)) return;
  ++object.middle_seen;
  const glm::dvec3 p = inverse(head)(object.middle.lower);
  const double off_rad = std::atan2(std::hypot(p.x, p.y), -p.z);
  if (off_rad >= object.least_rad) return;
  object.least_rad = off_rad;
  object.most_central = session_from_head;
}

Pose proposed(const Pose& world_from_session, const Pose& head, const BoundingSphere& subject) {
  glm::dvec3 ahead = level(head.orientation * glm::dvec3(0, 0, -1));
  ahead = glm::length(ahead) > 0.1 ? glm::normalize(ahead) : glm::dvec3(0, 0, -1);
  const glm::dvec3 way = subject.centre - head.position;
  const double distance = glm::length(way), flat = glm::length(level(way));
  const bool stays = distance > subject.radius + kClear_m && subject.radius >= kSmallest * distance &&
                     std::abs(way.y) <= kSteepest * flat;
  Pose turn;
  if (stays) {
    // About +Y from `ahead` to `way`.
    const double from = std::atan2(-ahead.x, -ahead.z), to = std::atan2(-way.x, -way.z);
    turn.orientation = glm::angleAxis(to - from, glm::dvec3(0, 1, 0));
    turn.position = head.position - turn.orientation * head.position;
    return turn * world_from_session;
  }
  const double back = std::max(subject.radius / kHalfWidth, subject.radius + kClear_m);
  glm::dvec3 place = subject.centre - back * ahead;
  if (std::abs(way.y) <= kSteepest * back) place.y = head.position.y;
  turn.position = place - head.position;
  return turn * world_from_session;
}

}  // namespace

ViewBorders view_borders(const DisplayProfile& profile) {
  ViewBorders borders;
  for (const Viewport& viewport : profile.viewports) {
    borders.left = std::min(borders.left, viewport.tan_left);
    borders.right = std::max(borders.right, viewport.tan_right);
    borders.down = std::min(borders.down, viewport.tan_down);
    borders.up = std::max(borders.up, viewport.tan_up);
  }
  return borders;
}

bool in_view(const Bounds& box, const Pose& world_from_head, const ViewBorders& borders) {
  const Pose head_from_world = inverse(world_from_head);
  std::array<bool, 5> all_beyond{true, true, true, true, true};
  for (unsigned corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p = head_from_world({(corner & 1u) != 0 ? box.upper.x : box.lower.x,
                                          (corner & 2u) != 0 ? box.upper.y : box.lower.y,
                                          (corner & 4u) != 0 ? box.upper.z : box.lower.z});
    const std::array<bool, 5> beyond{p.z >= 0, p.x<-p.z * borders.left, p.x> - p.z * borders.right,
                                     p.y<-p.z * borders.down, p.y> - p.z * borders.up};
    for (std::size_t i = 0; i < beyond.size(); ++i) all_beyond[i] = all_beyond[i] && beyond[i];
  }
  return std::none_of(all_beyond.begin(), all_beyond.end(), [](bool all) { return all; });
}

SceneInView look_at_scene(const Scene& scene, const std::vector<Pose>& poses, const Pose& median,
                          const DisplayProfile& profile, std::vector<SceneObject>& objects) {
  const ViewBorders borders = view_borders(profile);
  SceneState state;
  scene_state_at(scene, 0, state);
  const BoundingSphere subject = framed_sphere(scene, state).sphere;
  const Bounds middle{subject.centre, subject.centre};
  auto views = objects_by_name(scene);
  int middle_seen = 0;
  const std::vector<Pose> some = thinned(poses);
  for (const Pose& session_from_head : some) {
    const Pose head = scene.world_from_session * session_from_head;
    middle_seen += in_view(middle, head, borders) ? 1 : 0;
    for (auto& [name, object] : views) look(session_from_head, head, borders, object);
  }
  const auto share = [&](int count) { return static_cast<double>(count) / static_cast<double>(some.size()); };
  for (SceneObject& object : objects) {
    const auto found = views.find(object.name);
    if (found == views.end()) continue;
    object.in_view = share(found->second.seen);
    object.middle_in_view = share(found->second.middle_seen);
    if (found->second.middle_seen > 0) object.most_central = found->second.most_central;
  }
  SceneInView result;
  result.subject_share = share(middle_seen);
  if (subject.radius > 0 && 2 * middle_seen < static_cast<int>(some.size()))
    result.proposal = proposed(scene.world_from_session, scene.world_from_session * median, subject);
  return result;
}

std::string world_from_session_text(const Pose& pose) {
  const auto rounded = [](double value, double parts) {
    return shortest_text(std::round(value * parts) / parts + 0.0);  // -0 is 0
  };
  const glm::dvec3& p = pose.position;
  const glm::dquat& q = pose.orientation;
  std::string text = "\"world_from_session\": {\"position\": [";
  for (const double value : {p.x, p.y, p.z}) text += (text.ends_with('[') ? "" : ", ") + rounded(value, 1e4);
  text += "], \"orientation_xyzw\": [";
  for (const double value : {q.x, q.y, q.z, q.w})
    text += (text.ends_with('[') ? "" : ", ") + rounded(value, 1e6);
  return text + "]}";
}

}  // namespace herr
