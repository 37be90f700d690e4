#include "server/study/rate/rate_chain.h"

#include <utility>

namespace herr {

MachineUse RateChain::machine() const {
  MachineUse sum;
  for (const RateStep& step : steps) sum.add(step.answer.machine());
  return sum;
}

std::size_t RateChain::runs() const {
  std::size_t runs = 0;
  for (const RateStep& step : steps) {
    for (const MeasuredRate& each : step.answer.tried) runs += each.trials.size();
  }
  return runs;
}

std::optional<RateChain> run_rate_chain(const RenderSettings& asked, const AskRate& ask, const TellStep& tell,
                                        const RateTimeIsUp& time_is_up) {
  RateChain chain;
  RenderSettings settings = asked;
  SettingChanges changes;
  for (;;) {
    const std::optional<AskedRate> rate = ask(settings);
    if (!rate) return std::nullopt;
    chain.steps.push_back({changes, rate->answer});
    const RateAnswer& answer = rate->answer;
    if (answer.held || answer.open > 0 || !answer.refused) return chain;
    chain.next = next_try(*answer.refused, settings, rate->plan, answer.period_ms);
    chain.to_try = true;
    if (chain.next.changes.empty()) return chain;  // a lower rate is another question
    chain.ended_early = time_is_up && time_is_up();
    if (chain.ended_early) return chain;
    tell(*answer.refused, chain.next);
    chain.to_try = false;
    changes = merged(std::move(changes), chain.next.changes);
    settings = with_changes(settings, chain.next.changes);
  }
}

}  // namespace herr
