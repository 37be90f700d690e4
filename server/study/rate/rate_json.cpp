#include "server/study/rate/rate_json.h"

#include <nlohmann/json.hpp>

#include "server/settings/stage_remedy.h"
#include "server/study/rate/free_cores.h"
#include "server/study/rate/rate_search.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

Json text_json(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

Json setting_json(const RateSetting& setting) {
  return {{"polar", polar_text(setting)},
          {"polar_width_per_eye", setting.polar_width},
          {"polar_height", setting.polar_height},
          {"light_samples", setting.light_samples},
          {"profile_scale", setting.profile_scale}};
}

Json measured_json(const MeasuredRate& measured, double period_ms) {
  Json json = setting_json(measured.setting);
  json["p95_ms"] = measured.p95_ms;
  json["holds"] = measured.p95_ms <= period_ms;
  json["frames"] = measured.frames();
  json["viewport_pixels_share"] = measured.setting.profile_scale * measured.setting.profile_scale;
  const RateTrial& median = median_trial(measured.trials);
  json["k_radial"] = median.k_radial ? Json(*median.k_radial) : Json(nullptr);
  json["k_angular"] = median.k_angular ? Json(*median.k_angular) : Json(nullptr);
  json["runs"] = Json::array();
  for (const RateTrial& trial : measured.trials) {
    json["runs"].push_back({{"p95_ms", trial.p95_ms},
                            {"all_p95_ms", trial.all_p95_ms},
                            {"free_p95_ms", trial.free_p95_ms ? Json(*trial.free_p95_ms) : Json(nullptr)},
                            {"mean_ms", trial.frame_ms},
                            {"frames", trial.frames},
                            {"cut_short", trial.cut_short},
                            {"hopeless", trial.hopeless},
                            {"stretches", Json::array()}});
    for (const RateStretch& each : trial.stretches)
      json["runs"].back()["stretches"].push_back(
          {{"from_s", each.from_s}, {"to_s", each.to_s}, {"frames", each.frames}, {"p95_ms", each.p95_ms}});
  }
  return json;
}

Json machine_json(const MachineUse& machine) {
  const std::optional<double> share = machine.cpu_share();
  return {{"busy", machine.busy()},
          {"cpu_share", share ? Json(*share) : Json(nullptr)},
          {"preemptions", machine.preemptions},
          {"late_frames", machine.late},
          {"late_by_machine", machine.late_by_machine},
          {"steal", machine.steal()}};
}

Json prevented_json(const RateAnswer& answer) {
  if (!answer.refused) return nullptr;
  const LongestStage longest = longest_stage(answer.limit().trials);
  const std::string remedy =
      longest.stage ? stage_remedy(*longest.stage, answer.limit().setting.profile_scale) : "";
  return {{"stage", longest.name},
          {"remedy", text_json(remedy)},
          {"stage_ms", longest.ms},
          {"frame_ms", longest.frame_ms},
          {"setting", measured_json(*answer.refused, answer.period_ms)}};
}

Json held_json(const RateAnswer& answer) {
  return answer.held ? measured_json(*answer.held, answer.period_ms) : Json(nullptr);
}

// An estimate, where a busy machine gave the answer.
Json free_cores_json(const RateAnswer& answer) {
  const std::optional<FreeCores> free = free_cores_of(answer);
  if (!free) return nullptr;
  const auto json_of = [](const std::optional<FreeRate>& rate) {
    if (!rate) return Json(nullptr);
    Json json = setting_json(rate->setting);
    json["p95_ms"] = rate->p95_ms;
    return json;
  };
  return {{"holds", json_of(free->holds)}, {"holds_not", json_of(free->refused)}};
}

}  // namespace

Json rate_json(const RateQuestion& question, const RateAnswer& answer) {
  Json json{{"hz", question.hz},
            {"period_ms", answer.period_ms},
            {"profile", question.profile},
            {"holds", answer.held.has_value()},
            {"command_line", text_json(question.command_line)}};
  json["held"] = held_json(answer);
  json["prevented_by"] = prevented_json(answer);
  json["try_next"] = text_json(question.try_next);
  json["ended_early"] = answer.ended_early;
  json["open_settings"] = answer.open;
  json["machine"] = machine_json(answer.machine());
  json["estimate_for_free_cores"] = free_cores_json(answer);
  json["warnings"] = rate_warnings(answer);
  json["tried"] = Json::array();
  for (const MeasuredRate& each : answer.tried)
    json["tried"].push_back(measured_json(each, answer.period_ms));
  return json;
}

Json rate_json(const RateQuestion& question, const RateChain& chain) {
  Json json = rate_json(question, chain.last().answer);
  json["holds"] = chain.asked().held.has_value();
  json["holds_with_changes"] = chain.holds_with_changes();
  json["changes"] = text_json(flags_text(chain.last().changes));
  json["ended_early"] = chain.last().answer.ended_early || chain.ended_early;
  json["machine"] = machine_json(chain.machine());
  json["warnings"] = rate_warnings(chain);
  json["steps"] = Json::array();
  for (const RateStep& step : chain.steps) {
    json["steps"].push_back({{"changes", text_json(flags_text(step.changes))},
                             {"holds", step.answer.held.has_value()},
                             {"held", held_json(step.answer)},
                             {"prevented_by", prevented_json(step.answer)},
                             {"estimate_for_free_cores", free_cores_json(step.answer)}});
  }
  return json;
}

}  // namespace herr
