#include "server/check/check_command.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "server/check/check_against.h"
#include "server/check/check_baseline.h"
#include "server/check/measure/measure_run.h"
#include "server/check/measure/measured_program.h"
#include "server/check/measure/not_comparable.h"
#include "server/check/report/ci_reports.h"
#include "server/check/report/text_report.h"
#include "server/frames/warnings/picture_warnings.h"
#include "server/process/exit_code.h"
#include "server/process/steady_time.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/results/output_folder.h"
#include "server/results/summary_json.h"
#include "server/settings/option_checks.h"
#include "server/text/number_text.h"
#include "sessions/files/append_file.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr double kMoreSeconds = 4;  // where not even one run ended in time, a guess

int print_measurement(const CheckOptions& options) {
  end_at_once_on_signal();  // half a measurement is none
  check_render_settings(options.run.replay.render);
  print_result(measurement_json(measure_run(options.run)).dump() + "\n");
  return kExitDone;
}

void compare(const CheckOptions& options, CheckReport& report) {
  const TimeLimit limit = options.max_seconds ? TimeLimit(*options.max_seconds) : TimeLimit();
  try {
    if (!options.against.empty()) {
      check_against(options, limit, report);
    } else if (!options.baseline.empty()) {
      check_baseline(options, limit, report);
    } else {
      save_baseline(options, limit, report);
    }
  } catch (const NotComparable& difference) {
    report.verdict = Verdict::not_comparable;
    report.reason = difference.what();
  } catch (const OutOfTime&) {
    report.verdict = Verdict::inconclusive;
    report.ended_early = "--max-seconds ended it before there was anything to compare";
    report.advice = "give more, --max-seconds " + shortest_text(kMoreSeconds * *options.max_seconds) +
                    ", or fewer --frames";
    report.reason = report.ended_early + "; " + report.advice;
  }
}

void append(const std::filesystem::path& file, const std::string& text) {
  AppendFile appended(file, facts_of(file).size_bytes);  // 0 where it is not there yet
  appended.append(text);
  appended.finish();
}

void write_reports(const CheckOptions& options, const CheckReport& report) {
  if (!options.junit.empty()) write_whole_file(options.junit, check_junit(report));
  if (!options.markdown.empty()) append(options.markdown, check_markdown(report));
}

}  // namespace

int run_check(const CheckOptions& options) {
  if (options.measure) return print_measurement(options);
  CheckReport report;
  report.session = printable(session_folder_name(options.run.replay.sessions.front()));
  int exit_code = kExitDone;
  const std::int64_t start_ns = steady_now_ns();
  try {
    compare(options, report);
    exit_code = exit_code_of(report.verdict);
  } catch (const RunFailed& failure) {
    exit_code = failure.exit_code();
    report.error = failure.what();
    print_message(report.error);
  }
  for (const CounterJudgement& counter : report.counters) {
    if (counter.name != "object_samples") continue;
    const std::string warning = nothing_measured_warning(std::max(counter.baseline, counter.candidate));
    if (!warning.empty()) print_message("warning: " + warning);
  }
  report.seconds = 1e-9 * static_cast<double>(steady_now_ns() - start_ns);
  write_reports(options, report);
  if (options.json) {
    print_result(json_text(check_json(report)));
  } else if (report.error.empty()) {
    print_result(check_text(report));
  }
  if (options.github_annotations) print_result(check_annotations(report));
  return exit_code;
}

}  // namespace herr
