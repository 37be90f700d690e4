#include "server/study/rate/rate_command.h"

#include <nlohmann/json.hpp>

#include "server/process/exit_code.h"
#include "server/process/steady_time.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/results/summary_json.h"
#include "server/settings/option_checks.h"
#include "server/study/rate/next_try.h"
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

}  // namespace

int run_rate(const StudyOptions& options) {
  const TimeNs started_ns = steady_now_ns();
  const auto seconds = [started_ns] { return static_cast<double>(steady_now_ns() - started_ns) * 1e-9; };
  check_render_settings(options.render);
  const std::vector<RateSetting> ladder = rate_ladder(most_of(options));
  RateSubject subject(options, ladder.front());
  std::optional<RateAnswer> answer;
  {
    RateProgress progress(subject.period_ms());
    const auto time_is_up = [&] { return options.minutes_given && seconds() > 60 * options.minutes; };
    answer = run_rate_search(
        ladder, subject.period_ms(),
        [&](const RateSetting& setting, bool whole) { return subject.measure(setting, whole); },
        [&](const RateSetting& setting, const RateTrial& trial) { progress.tell(setting, trial); },
        time_is_up);
  }
  if (!answer) {
    print_message("stopped before there was an answer");
    return kExitSignalBase + stop_signal();
  }
  RateQuestion question{*options.hz, printable(subject.report().profile.name), "", ""};
  if (answer->held) question.command_line = command_line_of(options, answer->held->setting);
  if (!answer->held && answer->refused) {
    const NextTry next =
        next_try(*answer->refused, options.render, subject.report().plan.camera, subject.period_ms());
    StudyOptions less = options;
    if (next.hz) less.hz = next.hz;
    question.try_next = study_line_of(less, next.changes);
    question.try_words = next.words;
  }
  if (answer->open > 0)
    print_message("warning: " + too_few_minutes_text(options.minutes, seconds(), *answer));
  for (const std::string& warning : rate_warnings(*answer)) print_message("warning: " + warning);
  print_result(options.json ? json_text(rate_json(question, *answer)) : rate_text(question, *answer));
  return rate_exit_code(*answer);
}

}  // namespace herr
