#include "server/study/rate/rate_text.h"

#include <algorithm>
#include <cmath>

#include "server/process/exit_code.h"
#include "server/settings/stage_remedy.h"
#include "server/study/rate/free_cores.h"
#include "server/study/rate/rate_search.h"
#include "server/text/number_text.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

constexpr double kMostSpread = 0.1;

std::string ms_text(double ms) {
  return fixed_text(ms, 2) + " ms";
}

std::string setting_text(const RateSetting& setting, const std::string& profile) {
  return text_of(setting) + " of " + profile;
}

std::string seconds_text(const RateStretch& stretch) {
  return fixed_text(stretch.from_s, 1) + "\u2013" + fixed_text(stretch.to_s, 1) + " s";
}

// "the 95th percentile of 300 frames in 3 runs (their median) is 10.62 ms"; of several stretches "the 95th
// percentile of the heaviest of 4 stretches, 6.1–6.5 s, is 10.62 ms (300 frames in 3 runs, their median; of
// all stretches together 9.80 ms)".
std::string percentile_text(const MeasuredRate& measured) {
  const std::size_t runs = measured.trials.size();
  const std::string frames = std::to_string(measured.frames()) + " frames" +
                             (runs > 1 ? " in " + std::to_string(runs) + " runs" : "");
  const RateTrial& median = median_trial(measured.trials);
  const RateStretch* worst = worst_stretch(median);
  if (worst == nullptr || median.stretches.size() < 2 || worst->p95_ms < median.p95_ms) {
    return "the 95th percentile of " + frames + (runs > 1 ? " (their median)" : "") + " is " +
           ms_text(measured.p95_ms);
  }
  return "the 95th percentile of the heaviest of " + std::to_string(median.stretches.size()) +
         " stretches, " + seconds_text(*worst) + ", is " + ms_text(measured.p95_ms) + " (" + frames +
         (runs > 1 ? ", their median" : "") + "; of all stretches together " + ms_text(median.all_p95_ms) +
         ")";
}

// "Measured at 0.8–1.2 s, 2.1–2.5 s and 3.4–3.8 s of the session; what lies between was not."; empty where
// the stretches are not known.
std::string stretches_sentence(const RateAnswer& answer) {
  const RateTrial* longest = nullptr;  // a measurement that ended early has fewer
  for (const MeasuredRate& each : answer.tried) {
    for (const RateTrial& trial : each.trials)
      if (longest == nullptr || trial.frames > longest->frames) longest = &trial;
  }
  if (longest == nullptr || longest->stretches.empty()) return "";
  const std::vector<RateStretch>& all = longest->stretches;
  std::string text = "Measured at ";
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0) text += i + 1 < all.size() ? ", " : " and ";
    text += seconds_text(all[i]);
  }
  return text + " of the session" + (all.size() > 1 ? "; what lies between was not" : "") + ".\n";
}

std::string stage_text(const MeasuredRate& measured) {
  const LongestStage longest = longest_stage(measured.trials);
  const std::string remedy =
      longest.stage ? stage_remedy(*longest.stage, measured.setting.profile_scale) : "";
  return longest.name + (remedy.empty() ? "" : " (" + remedy + ")") + ", " + ms_text(longest.ms) +
         " of the mean " + ms_text(longest.frame_ms);
}

// Of a search that the time ended: what is known, and what is not.
std::string open_sentences(const RateQuestion& question, const RateAnswer& answer) {
  std::string text = shortest_text(question.hz) + " Hz leaves " + ms_text(answer.period_ms) +
                     " for a frame, and the search ended before its answer: ";
  if (answer.held) {
    text += "of what was measured the largest setting that holds is " +
            setting_text(answer.held->setting, question.profile) + ", " + percentile_text(*answer.held);
  } else {
    text += "no setting that was measured holds that";
  }
  text += ".\n";
  const std::string open = counted(static_cast<std::int64_t>(answer.open), "setting is", "settings are");
  if (!answer.refused)
    return text + "Of " + (answer.held ? "larger ones " : "all others ") + open + " open.\n";
  return text + "Below " + setting_text(answer.refused->setting, question.profile) +
         ", which does not hold (" + ms_text(answer.refused->p95_ms) + ", most of it " +
         stage_text(*answer.refused) + "), " + open + " open.\n";
}

// "23.2 Hz": the rate that frames of `p95_ms` are enough for.
std::string hz_text(double p95_ms) {
  return fixed_text(std::floor(1e4 / p95_ms) / 10, 1) + " Hz";
}

std::string hopeless_text(const MeasuredRate& measured) {
  if (!measured.trials.back().hopeless) return {};
  const std::string times = " took more than " + fixed_text(kHopelessTimes, 0) + " times as long as it may, ";
  return measured.trials.size() == 1 ? "; each of them" + times + "so that one short run was enough"
                                     : "; each of the last run" + times + "so that it was not repeated";
}

// What the setting is to a viewer, and the rate at all pixels of the display if that was measured.
std::string viewer_sentences(const RateAnswer& answer) {
  const MeasuredRate& held = *answer.held;
  const double scale = held.setting.profile_scale;
  std::string text = "To a viewer: " + shortest_text(std::round(1e3 * scale * scale) / 10) +
                     " % of the pixels of the viewports (profile scale squared)";
  const RateTrial& trial = median_trial(held.trials);
  if (trial.k_radial && trial.k_angular) {
    text += "; acuity at the gaze: k radial " + fixed_text(*trial.k_radial, 1) + ", k angular " +
            fixed_text(*trial.k_angular, 1) +
            " (samples per degree times theta + 1; 200 / (theta + 1) asks "
            "for 200)";
  }
  text += ".\n";
  const auto full = std::find_if(answer.tried.begin(), answer.tried.end(),
                                 [](const MeasuredRate& each) { return each.setting.profile_scale == 1; });
  if (scale == 1 || full == answer.tried.end()) return text;
  return text + "With all pixels (profile scale 1) the smallest that was measured, polar " +
         polar_text(full->setting) + ", light samples " + std::to_string(full->setting.light_samples) +
         ", is enough for " + hz_text(full->p95_ms) + " (" + ms_text(full->p95_ms) + ", " +
         counted(full->frames(), "frame", "frames") + ").\n";
}

std::string first_sentence(const RateQuestion& question, const RateAnswer& answer) {
  const std::string asked =
      shortest_text(question.hz) + " Hz leaves " + ms_text(answer.period_ms) + " for a frame, and ";
  if (!answer.held) {
    const MeasuredRate& least = *answer.refused;
    return asked + "this machine holds that with no setting down to " +
           setting_text(least.setting, question.profile) +
           " (an eighth of the width and a quarter of the height of --polar): there " +
           percentile_text(least) + ", enough for " + hz_text(least.p95_ms) + hopeless_text(least) + ".";
  }
  const MeasuredRate& held = *answer.held;
  return asked +
         (answer.refused ? "the largest setting with which this machine holds that is "
                         : "this machine holds that even with the largest setting that was tried, ") +
         setting_text(held.setting, question.profile) + ": " + percentile_text(held) + ".";
}

std::string second_sentence(const RateQuestion& question, const RateAnswer& answer) {
  if (!answer.held) return "The stage that prevents it is " + stage_text(*answer.refused) + ".";
  if (!answer.refused) {
    return "No stage prevents more (the longest is " + stage_text(*answer.held) +
           "); --polar, --light-samples, --profile and --profile-scale say the most that is tried.";
  }
  return "The stage that prevents more is " + stage_text(*answer.refused) +
         " of a frame of the next larger, " + setting_text(answer.refused->setting, question.profile) +
         ", whose 95th percentile is " + ms_text(answer.refused->p95_ms) + ".";
}

// All but the lines to be pasted.
std::string sentences(const RateQuestion& question, const RateAnswer& answer) {
  std::string text = answer.open > 0
                         ? open_sentences(question, answer)
                         : first_sentence(question, answer) + "\n" + second_sentence(question, answer) + "\n";
  if (answer.held) text += viewer_sentences(answer);
  return text + stretches_sentence(answer);
}

std::string lines_to_paste(const RateQuestion& question) {
  std::string text;
  if (!question.command_line.empty()) text += "\n" + question.command_line + "\n";
  if (!question.try_next.empty())
    text += "\nTo try next, " + question.try_words + ":\n" + question.try_next + "\n";
  return text;
}

// What free cores would hold of an answer, where a busy machine gave it.
void add_estimate(std::vector<std::string>& warnings, const RateAnswer& answer, const std::string& of_what) {
  const std::optional<FreeCores> free = free_cores_of(answer);
  if (!free) return;
  warnings.push_back("an estimate for cores that nobody else has, not measured" + of_what + ": " +
                     free_cores_text(*free) +
                     "; 95th percentiles of frames less what their threads waited for cores, at best");
}

void add_busy(std::vector<std::string>& warnings, const MachineUse& machine) {
  if (!machine.busy()) return;
  warnings.push_back("the machine was busy with something else (" + machine.text() +
                     "): a quiet one holds more; repeat this when it is");
}

void add_spread(std::vector<std::string>& warnings, const RateAnswer& answer) {
  if (!answer.held && !answer.refused) return;
  const MeasuredRate& told = answer.held ? *answer.held : *answer.refused;
  const double spread = spread_of(told.trials);
  if (spread <= kMostSpread) return;
  warnings.push_back("the 95th percentiles of the " + std::to_string(told.trials.size()) +
                     " runs differ by " + fixed_text(100 * spread, 0) +
                     " %: the setting may not hold every time; take a smaller one for certain");
}

// "--minutes 0.1 ended the search after 2 runs, and it takes about 6 more; give --minutes 1 or more".
std::string more_minutes_text(double minutes, double seconds, std::size_t runs, std::size_t to_go) {
  constexpr double kRoom = 1.5;  // larger settings take longer, and machines are busy
  const double all = static_cast<double>(runs + to_go) / static_cast<double>(runs);
  return "--minutes " + shortest_text(minutes) + " ended the search after " +
         counted(static_cast<std::int64_t>(runs), "run", "runs") + ", and it takes about " +
         std::to_string(to_go) + " more; give --minutes " +
         fixed_text(std::ceil(kRoom * all * seconds / 60), 0) + " or more";
}

}  // namespace

std::string rate_text(const RateQuestion& question, const RateAnswer& answer) {
  return sentences(question, answer) + lines_to_paste(question);
}

std::string rate_text(const RateQuestion& question, const RateChain& chain) {
  const RateAnswer& last = chain.last().answer;
  if (chain.steps.size() == 1) return rate_text(question, last);
  const std::string flags = flags_text(chain.last().changes);
  std::string text = sentences(question, chain.asked()) + "\nWhat was asked does not hold; ";
  if (last.held) {
    text += "changed by " + flags + " it does:\n";
  } else if (last.open > 0) {
    text += "changed by " + flags + " it is not certain:\n";
  } else {
    text += "not even changed by " + flags + " does it:\n";
  }
  return text + sentences(question, last) + lines_to_paste(question);
}

std::vector<std::string> rate_warnings(const RateAnswer& answer) {
  std::vector<std::string> warnings;
  add_busy(warnings, answer.machine());
  add_estimate(warnings, answer, "");
  add_spread(warnings, answer);
  return warnings;
}

std::vector<std::string> rate_warnings(const RateChain& chain) {
  const RateAnswer& last = chain.last().answer;
  if (chain.steps.size() == 1) return rate_warnings(last);
  std::vector<std::string> warnings;
  add_busy(warnings, chain.machine());
  add_estimate(warnings, chain.asked(), ", of what was asked");
  add_estimate(warnings, last, ", with " + flags_text(chain.last().changes));
  add_spread(warnings, last);
  return warnings;
}

std::string too_few_minutes_text(double minutes, double seconds, const RateChain& chain) {
  const RateAnswer& last = chain.last().answer;
  if (last.open > 0) return more_minutes_text(minutes, seconds, chain.runs(), last.runs_to_go);
  if (!chain.ended_early) return {};
  std::size_t of_last = 0;  // the next step takes about as many, and more where it finds something
  for (const MeasuredRate& each : last.tried) of_last += each.trials.size();
  return more_minutes_text(minutes, seconds, chain.runs(), of_last + kRunsAtTheEnd);
}

int rate_exit_code(const RateAnswer& answer) {
  if (answer.held) return answer.open > 0 ? kExitPartial : kExitDone;
  if (answer.open > 0) return kExitInconclusive;
  return answer.machine().busy() ? kExitInconclusive : kExitRegression;
}

int rate_exit_code(const RateChain& chain) {
  return rate_exit_code(chain.asked());
}

}  // namespace herr
