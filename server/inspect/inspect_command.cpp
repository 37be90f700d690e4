#include "server/inspect/inspect_command.h"

#include <nlohmann/json.hpp>

#include "server/inspect/inspect_json.h"
#include "server/inspect/inspect_report.h"
#include "server/inspect/inspect_text.h"
#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/results/summary_json.h"
#include "server/settings/option_checks.h"
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

}  // namespace

int run_inspect(const InspectOptions& options) {
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
  print_result(options.json ? json_text(inspect_json(report)) : inspect_text(report));
  if (report.sound()) return kExitDone;
  print_message(report.findings.first_error()->text());
  return kExitBadInput;
}

}  // namespace herr
