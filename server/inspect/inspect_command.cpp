#include "server/inspect/inspect_command.h"

#include <nlohmann/json.hpp>

#include "server/inspect/acuity/acuity_picture.h"
#include "server/inspect/inspect_json.h"
#include "server/inspect/inspect_report.h"
#include "server/inspect/inspect_text.h"
#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/results/summary_json.h"
#include "server/settings/option_checks.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

// False: a signal asked for the end.
bool add_probes(const InspectOptions& options, NewFolder& folder, InspectReport& report) {
  if (!report.loaded) {
    report.findings.add(Severity::error, InputError(options.path, 0, "names no scene, so there are no probes",
                                                    "give --scene FILE"));
    return true;
  }
  const bool camera = report.session && report.session->has_camera_feed();
  const ProbeScene from{*report.loaded, report.scene_file, report.settings, camera,
                        report.profile.display_hz};
  try {
    report.probes = dump_probes(from, options.probes, folder);
  } catch (const InputError& error) {
    report.findings.add(Severity::error, error);
    return true;
  }
  return report.probes.has_value();
}

void check_acuity_plot(const InspectOptions& options) {
  const std::filesystem::path& file = options.acuity_plot;
  if (file.empty()) return;
  const std::string name = printable(file.string());
  if (options.render.foveation == Foveation::off)
    throw UsageError("--acuity-plot: --foveation off has no polar buffers; give one of the two");
  if (file.extension() != ".svg")
    throw UsageError("--acuity-plot: '" + name + "' does not end with .svg; name a file that does");
  if (is_folder(file)) throw UsageError("--acuity-plot: '" + name + "' is a folder; name a file");
  if (path_exists(file) && !options.overwrite)
    throw UsageError("--acuity-plot: '" + name + "' is there already; give --overwrite to replace it");
}

void write_acuity_plot(const InspectOptions& options, InspectReport& report) {
  if (options.acuity_plot.empty() || !report.acuity) return;
  write_whole_file(options.acuity_plot, acuity_picture(*report.acuity, report.settings));
  report.acuity_plot = options.acuity_plot;
}

}  // namespace

int run_inspect(const InspectOptions& options) {
  check_acuity_plot(options);
  const bool writes = !options.probes.folder.empty();
  if (!writes) end_at_once_on_signal();
  if (const int signal = stop_signal(); signal != 0) return kExitSignalBase + signal;
  if (writes) check_render_settings(options.render);
  const std::unique_ptr<NewFolder> folder = writes ? probe_folder(options.probes) : nullptr;
  InspectReport report = inspect(options);
  if (writes && report.sound() && !add_probes(options, *folder, report)) {
    print_message("stopped: nothing was written");
    return kExitSignalBase + stop_signal();
  }
  if (report.sound()) write_acuity_plot(options, report);
  print_result(options.json ? json_text(inspect_json(report)) : inspect_text(report));
  if (report.sound()) return kExitDone;
  print_message(report.findings.first_error()->text());
  return kExitBadInput;
}

}  // namespace herr
