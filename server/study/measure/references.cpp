#include "server/study/measure/references.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "server/process/version.h"
#include "server/results/settings_report.h"
#include "server/study/plan/study_setting.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr std::ptrdiff_t kMostOfSeeds = 2;

std::string key_of(const ReferenceSpec& spec, const FrameInstant& instant, const std::string& subject) {
  const SettingChanges all = changes_between(RenderSettings{}, spec.settings);
  std::string text = std::string(program_with_version()) + "; " + subject + "; frame " +
                     std::to_string(instant.number) + "; " + std::to_string(spec.passes) + " passes" +
                     (spec.refined ? "" : ", no more") + (spec.same_probes ? ", probes of the setting" : "");
  for (const auto& [name, value] : all) {
    if (name != "threads") text += "; " + name + " " + value;
  }
  return text;
}

}  // namespace

const ReferencePicture& References::get(const ReferenceSpec& spec, bool improve) {
  const auto found = std::find_if(kept_.begin(), kept_.end(),
                                  [&](const ReferencePicture& kept) { return kept.spec == spec; });
  if (found != kept_.end()) return *found;
  kept_.push_back(make(spec, improve));
  const auto of_seeds = [](const ReferencePicture& kept) { return !kept.spec.by_pixels; };
  if (std::count_if(kept_.begin(), kept_.end(), of_seeds) > kMostOfSeeds) {
    kept_.erase(std::find_if(kept_.begin(), kept_.end(), of_seeds));
  }
  return kept_.back();
}

ReferencePicture References::make(const ReferenceSpec& spec, bool improve) {
  if (context_.tell) context_.tell("reference: " + spec.name);
  const std::string key = key_of(spec, instant_, context_.subject);
  std::optional<ReferenceHalves> halves;
  const bool cached = spec.by_pixels && context_.cache != nullptr;
  if (cached) halves = context_.cache->load(key, *instant_.profile);
  if (cached && !halves && context_.is_known && context_.is_known(spec.name)) {
    throw InputError(context_.cache->folder(), 0,
                     "has no longer the reference '" + spec.name + "' that rows were measured against" +
                         (context_.cache->remark().empty() ? "" : " (" + context_.cache->remark() + ")"),
                     "put it back, or begin anew with --overwrite");
  }
  if (cached && context_.warn && !context_.cache->remark().empty()) context_.warn(context_.cache->remark());
  bool found = halves.has_value();
  if (!halves || (improve && !halves->goal_met)) {
    ReferenceHalves fresh = render_halves(spec, instant_, context_.out_of_time, context_.one_pass);
    const bool better = !halves || fresh.goal_met || fresh.passes > halves->passes ||
                        (fresh.passes == halves->passes && fresh.most_passes > halves->most_passes);
    if (better) halves = std::move(fresh), found = false;
    const bool stopped = context_.stopped && context_.stopped();
    if (better && cached && !stopped) context_.cache->store(key, *halves);
  }
  ReferencePicture reference = mean_of_halves(spec, instant_, std::move(*halves), context_.parallel_for);
  reference.found = found;
  seconds_ += reference.seconds;
  ReferencePicture described = reference;
  described.picture.clear();
  const bool known = std::any_of(made_.begin(), made_.end(),
                                 [&](const ReferencePicture& made) { return made.spec == spec; });
  if (!known) made_.push_back(std::move(described));
  return reference;
}

}  // namespace herr
