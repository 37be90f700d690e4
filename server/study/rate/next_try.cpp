#include "server/study/rate/next_try.h"

#include <cmath>
#include <utility>

#include "server/settings/stage_remedy.h"

namespace herr {
namespace {

constexpr int kLeastColumns = 64, kLeastRows = 64;  // of a --polar that is worth asking for

// Of a stage that two flags leave out, the scene may have what only one of them is for.
bool has_something_for(const FramePlan& plan, const std::string& setting) {
  if (setting == "reflections") return plan.mirror_rays;
  if (setting == "refraction") return plan.refraction;
  return true;
}

// Those that `asked` does not have yet: what bounces is lit without probes, too.
SettingChanges new_ones(const RenderSettings& asked, const FramePlan& plan, const SettingChanges& changes) {
  SettingChanges left;
  for (const auto& change : changes) {
    if (!has_something_for(plan, change.first)) continue;
    if (!changes_between(asked, with_changes(asked, {change})).empty()) left.push_back(change);
  }
  return left;
}

}  // namespace

NextTry next_try(const MeasuredRate& smallest, const RenderSettings& asked, const FramePlan& plan,
                 double period_ms) {
  const LongestStage longest = longest_stage(smallest.trials);
  const bool pixels = longest.stage == Stage::viewports;
  NextTry next;
  next.changes = new_ones(asked, plan, changes_without_long_stages(mean_stages(smallest.trials)));
  if (pixels && plan.camera && asked.camera)
    next.changes = merged(std::move(next.changes), {{"camera", "off"}});
  if (!next.changes.empty()) {
    next.words = "without what flags leave out";
    return next;
  }
  RateSetting half;
  half.polar_width = asked.polar_width / 2, half.polar_height = asked.polar_height / 4 * 2;
  const bool hopeless = pixels && longest.ms > period_ms;  // however little the polar buffers take
  if (!hopeless && 2 * half.polar_width >= kLeastColumns && half.polar_height >= kLeastRows) {
    next.changes = {{"polar", polar_text(half)}};
    next.words = "with half of --polar";
    return next;
  }
  const double hz = 1e3 / smallest.p95_ms;
  next.hz = hz >= 1 ? std::floor(hz) : std::floor(1e3 * hz) / 1e3;
  next.words = "the rate that the smallest is enough for";
  return next;
}

}  // namespace herr
