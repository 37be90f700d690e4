#include "server/inspect/inspect_command.h"

#include "server/cli/exit_code.h"
#include "server/cli/stop_signal.h"
#include "server/cli/terminal.h"
#include "server/inspect/inspect_json.h"
#include "server/inspect/inspect_report.h"
#include "server/inspect/inspect_text.h"
#include "server/replay/summary_json.h"

namespace herr {

int run_inspect(const InspectOptions& options) {
  end_at_once_on_signal();  // nothing is written
  if (const int signal = stop_signal(); signal != 0) return kExitSignalBase + signal;
  const InspectReport report = inspect(options);
  print_result(options.json ? json_text(inspect_json(report)) : inspect_text(report));
  if (report.sound()) return kExitDone;
  print_message(report.findings.first_error()->text());
  return kExitBadInput;
}

}  // namespace herr
