#include "server/study/relations/relation.h"

#include <limits>
#include <stdexcept>
#include <utility>

#include "renderer/frame_plan.h"
#include "server/process/steady_time.h"
#include "server/study/relations/relation_groups.h"

namespace herr {

double RelationResult::share_of_bound() const {
  if (!asked()) return 0;
  if (relation.bound > 0) return error / relation.bound;
  return error == 0 ? 0 : std::numeric_limits<double>::infinity();
}

void RelationLog::begin_group(std::string name) {
  group_ = std::move(name);
  last_ns_ = steady_now_ns();
}

void RelationLog::measured(Relation relation, double error, std::string where,
                           std::optional<RelationPictures> pictures) {
  RelationResult result;
  result.relation = std::move(relation);
  result.error = error;
  result.where = std::move(where);
  result.pictures = std::move(pictures);
  add(std::move(result));
}

void RelationLog::not_applicable(Relation relation, std::string why) {
  if (why.empty()) throw std::invalid_argument("a relation that is not asked needs a reason");
  RelationResult result;
  result.relation = std::move(relation);
  result.not_applicable = std::move(why);
  add(std::move(result));
}

void RelationLog::add(RelationResult result) {
  result.group = group_;
  const TimeNs now_ns = steady_now_ns();
  result.seconds = static_cast<double>(now_ns - last_ns_) * 1e-9;
  last_ns_ = now_ns;
  results_.push_back(std::move(result));
  if (tell_) tell_(results_.back());
}

std::span<const RelationGroup> relation_groups() {
  static constexpr RelationGroup kGroups[] = {
      {"place", "moved, turned and scaled scenes give the same picture", measure_place},
      {"stamps", "stamps shifted by hours and to the last legal one give the same picture", measure_stamps},
      {"light", "light times k, the sum of lights, lights inside and on surfaces", measure_light},
      {"samples", "light samples up: no bias, less noise", measure_samples},
      {"surfaces", "roughness 0, index of refraction 1 and 10, albedo 0 and 1", measure_surfaces},
      {"gaze", "gaze, polar widths and viewports at their limits", measure_gaze},
      {"triangles", "needle, duplicate, degenerate and huge triangles; tiny and huge voxels",
       measure_triangles},
      {"probes", "memory of 0 and nearly all, lights that are switched", measure_probes},
      {"control", "prediction, width control, loads that step", measure_control},
      {"threads", "threads and instruction sets", measure_threads},
  };
  return kGroups;
}

std::string why_left_out(const FramePlan& plan, const std::string& entry) {
  for (const PlanEntry& candidate : plan.entries) {
    if (candidate.name == entry) return candidate.runs ? std::string() : candidate.reason;
  }
  throw std::invalid_argument("the frame plan has no entry " + entry);
}

}  // namespace herr
