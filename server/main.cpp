// herr: replays recorded XR sessions and ray-traces each frame. A table of contents;
// every command is in a folder.
#include "server/bench/bench_command.h"
#include "server/check/check_command.h"
#include "server/cli/command_line.h"
#include "server/convert/convert_command.h"
#include "server/inspect/inspect_command.h"
#include "server/look/look_command.h"
#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/replay/replay_command.h"
#include "server/serve/serve_command.h"
#include "server/settings/option_checks.h"
#include "server/study/rate/rate_command.h"
#include "server/study/stability/report_again.h"
#include "server/study/stability/stability_command.h"
#include "server/study/study_command.h"
#include "server/synth/synth_command.h"

namespace {

struct RunCommand {
  int operator()(const herr::ShowText& show) const {
    herr::print_result(show.text);
    return herr::kExitDone;
  }
  int operator()(const herr::ReplayOptions& options) const {
    herr::warn_of_idle_settings(options.render);
    return herr::run_replay(options);
  }
  int operator()(const herr::ServeOptions& options) const {
    herr::warn_of_idle_settings(options.replay.render);
    return herr::run_serve(options);
  }
  int operator()(const herr::BenchOptions& options) const {
    herr::warn_of_idle_settings(options.render);
    return herr::run_bench(options);
  }
  int operator()(const herr::CheckOptions& options) const {
    if (!options.measure) herr::warn_of_idle_settings(options.run.replay.render);
    return herr::run_check(options);
  }
  int operator()(const herr::InspectOptions& options) const {
    herr::warn_of_idle_settings(options.render);
    return herr::run_inspect(options);
  }
  int operator()(const herr::LookOptions& options) const {
    herr::warn_of_idle_settings(options.render);
    return herr::run_look(options);
  }
  int operator()(const herr::StudyOptions& options) const {
    if (!options.report.empty()) return herr::print_report_again(options);
    herr::warn_of_idle_settings(options.render);
    if (options.hz) return herr::run_rate(options);
    return options.stability ? herr::run_stability(options) : herr::run_study(options);
  }
  int operator()(const herr::SynthOptions& options) const {
    herr::warn_of_threads(options.threads);
    return herr::run_synth(options);
  }
  int operator()(const herr::ConvertOptions& options) const { return herr::run_convert(options); }
};

}  // namespace

int main(int argc, char** argv) {
  herr::install_signal_handling();
  return herr::run_guarded([&] {
    const herr::Command command = herr::parse_command_line({argv + (argc > 0 ? 1 : 0), argv + argc});
    return std::visit(RunCommand{}, command);
  });
}
