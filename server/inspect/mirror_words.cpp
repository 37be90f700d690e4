#include "server/inspect/mirror_words.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "server/text/number_text.h"

namespace herr {
namespace {

bool runs(const FramePlan& plan, const char* name) {
  return std::any_of(plan.entries.begin(), plan.entries.end(),
                     [&](const PlanEntry& entry) { return entry.name == name && entry.runs; });
}

// Between what two pixels of a lens see.
double degrees_between(const CameraModel& lens, const glm::dvec2& a, const glm::dvec2& b) {
  const auto to_a = lens.unproject(a), to_b = lens.unproject(b);
  // Corners of a circular picture see nothing: then as far as the lens does.
  if (!to_a || !to_b) return glm::degrees(2 * lens.max_angle_rad);
  return glm::degrees(std::acos(std::clamp(glm::dot(*to_a, *to_b), -1.0, 1.0)));
}

// Across and down through the middle of the picture, each as two halves: a fisheye sees more than 180
// degrees.
std::string view_words(const CameraModel& lens) {
  const double right = lens.width_px - 1.0, bottom = lens.height_px - 1.0;
  const glm::dvec2 middle{right / 2, bottom / 2};
  const auto whole = [&](const glm::dvec2& a, const glm::dvec2& b) {
    return fixed_text(degrees_between(lens, a, middle) + degrees_between(lens, middle, b), 0);
  };
  return whole({0, middle.y}, {right, middle.y}) + " x " + whole({middle.x, 0}, {middle.x, bottom}) +
         " degrees";
}

std::string views_words(const InspectReport& report) {
  std::string text;
  if (!report.session || !report.session->header) return text;
  for (const auto& camera : report.session->header->cameras)
    text += (text.empty() ? "" : " and ") + view_words(camera.model);
  return text;
}

}  // namespace

std::vector<std::string> mirror_words(const InspectReport& report) {
  if (!report.plan || !report.scene) return {};
  const FramePlan& plan = *report.plan;
  if (!runs(plan, "mirror rays") && !runs(plan, "refraction")) return {};
  if (!report.session && report.settings.camera)
    return {"show the environment, and real surfaces by their stated colour, unless a session brings a feed"};
  if (!plan.mirrored_feed) {
    return {std::string("show ") + (plan.camera
                                        ? "virtual things alone, in real surfaces"
                                        : "the environment, and real surfaces by their stated colour: "
                                          "no camera feed is shown")};
  }
  return {
      "show the camera feed inside the camera's view (" + views_words(report) +
          "), beyond it the environment",
      "show real surfaces (catchers) by the feed, with the shadows that virtual things cast on them; where "
      "the camera or the eye does not see them, by their stated colour",
      "cannot show what real things hide from the camera; what is real and no catcher counts as far away as "
      "the feed; short occlusion rays and what real surfaces mirror are left out"};
}

}  // namespace herr
