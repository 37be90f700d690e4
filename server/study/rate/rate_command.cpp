#include "server/study/rate/rate_command.h"

#include <nlohmann/json.hpp>

#include "server/process/exit_code.h"
#include "server/process/steady_time.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/results/summary_json.h"
#include "server/settings/option_checks.h"
#include "server/study/rate/rate_chain.h"
#include "server/study/rate/rate_json.h"
#include "server/study/rate/rate_subject.h"
#include "server/study/rate/rate_text.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

// The line that a terminal shows meanwhile; it goes away at the end.
class RateProgress {
 public:
  explicit RateProgress(double period_ms) : shown_(stderr_is_terminal()), period_ms_(period_ms) {}
  ~RateProgress() {
    if (shown_) print_progress("\r\033[K");
  }
  RateProgress(const RateProgress&) = delete;
  RateProgress& operator=(const RateProgress&) = delete;

  void tell(const RateSetting& setting, const RateTrial& trial) {
    ++trials_;
    if (!shown_) return;
    print_progress("\r\033[Krun " + std::to_string(trials_) + ": " + text_of(setting) + ": p95 " +
                   fixed_text(trial.p95_ms, 2) + " of " + fixed_text(period_ms_, 2) + " ms");
  }

 private:
  const bool shown_;
  const double period_ms_;
  int trials_ = 0;
};

// Why there is another step, and what it leaves out.
std::string step_text(const StudyOptions& options, const MeasuredRate& smallest, double period_ms,
                      const NextTry& next, std::size_t step) {
  const LongestStage longest = longest_stage(smallest.trials);
  return "no setting holds " + shortest_text(*options.hz) + " Hz " +
         (step == 1 ? "as asked" : "with these changes either") + ": the smallest takes " +
         fixed_text(smallest.p95_ms, 2) + " of " + fixed_text(period_ms, 2) + " ms, most of its mean " +
         longest.name + " (" + fixed_text(longest.ms, 2) + " of " + fixed_text(longest.frame_ms, 2) +
         " ms); step " + std::to_string(step) + ", " + next.words + ": " + flags_text(next.changes);
}

class RateAsking {
 public:
  explicit RateAsking(const StudyOptions& options) : options_(options), started_ns_(steady_now_ns()) {}

  double seconds() const { return static_cast<double>(steady_now_ns() - started_ns_) * 1e-9; }
  bool time_is_up() const { return options_.minutes_given && seconds() > 60 * options_.minutes; }

  std::optional<RateChain> run() {
    return run_rate_chain(
        options_.render, [this](const RenderSettings& settings) { return ask(settings); },
        [this](const MeasuredRate& smallest, const NextTry& next) {
          print_message(step_text(options_, smallest, 1e3 / *options_.hz, next, ++step_));
        },
        [this] { return time_is_up(); });
  }
  const std::string& profile() const { return profile_; }

 private:
  std::optional<AskedRate> ask(const RenderSettings& settings) {
    StudyOptions options = options_;
    options.render = settings;
    check_render_settings(settings);
    const std::vector<RateSetting> ladder = rate_ladder(most_of(options));
    RateSubject subject(options, ladder.front());
    profile_ = printable(subject.report().profile.name);
    RateProgress progress(subject.period_ms());
    const std::optional<RateAnswer> answer = run_rate_search(
        ladder, subject.period_ms(),
        [&](const RateSetting& setting, bool whole) { return subject.measure(setting, whole); },
        [&](const RateSetting& setting, const RateTrial& trial) { progress.tell(setting, trial); },
        [this] { return time_is_up(); });
    if (!answer) return std::nullopt;
    return AskedRate{*answer, subject.report().plan};
  }

  const StudyOptions& options_;
  const TimeNs started_ns_;
  std::size_t step_ = 0;
  std::string profile_;
};

// What was asked, and the lines to be pasted.
RateQuestion question_of(const StudyOptions& options, const RateChain& chain, const std::string& profile) {
  RateQuestion question{*options.hz, profile, "", ""};
  StudyOptions less = options;
  less.render = with_changes(options.render, chain.last().changes);
  if (chain.last().answer.held)
    question.command_line = command_line_of(less, chain.last().answer.held->setting);
  if (chain.to_try) {
    if (chain.next.hz) less.hz = chain.next.hz;
    question.try_next = study_line_of(less, chain.next.changes);
    question.try_words = chain.next.words;
  }
  return question;
}

}  // namespace

int run_rate(const StudyOptions& options) {
  RateAsking asking(options);
  const std::optional<RateChain> chain = asking.run();
  if (!chain) {
    print_message("stopped before there was an answer");
    return kExitSignalBase + stop_signal();
  }
  const RateQuestion question = question_of(options, *chain, asking.profile());
  const std::string too_few = too_few_minutes_text(options.minutes, asking.seconds(), *chain);
  if (!too_few.empty()) print_message("warning: " + too_few);
  for (const std::string& warning : rate_warnings(*chain)) print_message("warning: " + warning);
  print_result(options.json ? json_text(rate_json(question, *chain)) : rate_text(question, *chain));
  return rate_exit_code(*chain);
}

}  // namespace herr
