#include "server/replay/session_check.h"

#include <nlohmann/json.hpp>

#include "server/frames/opened_session.h"
#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/results/output_folder.h"
#include "server/results/summary_json.h"
#include "sessions/files/atomic_file.h"

namespace herr {
namespace {

SessionReport check_session(const std::filesystem::path& session, const ReplayOptions& options) {
  SessionReport report;
  report.name = session_folder_name(session);
  report.session_folder = session;
  report.out_folder = OutputFolder(options.out, session).path();
  try {
    OpenedSession opened;
    open_inputs(options, report, opened);
    report.warnings = opened.scene.warnings;
  } catch (...) {
    std::string error;
    const int exit_code = exit_code_of_current_exception(error);
    if (exit_code == kExitTemporary) return report;
    report.state = ReplayState::failed;
    report.unopened = true;
    report.exit_code = exit_code;
    report.error = error;
    add_keep_going(options, report);
  }
  return report;
}

}  // namespace

std::vector<SessionReport> check_sessions(const ReplayOptions& options) {
  std::vector<SessionReport> reports(options.sessions.size());
  if (reports.size() < 2) return reports;
  for (std::size_t i = 0; i < reports.size() && stop_signal() == 0; ++i) {
    reports[i] = check_session(options.sessions[i], options);
    if (reports[i].unopened) print_message(reports[i].error);
  }
  return reports;
}

void add_keep_going(const ReplayOptions& options, SessionReport& report) {
  if (report.exit_code != kExitBadInput || options.session.keep_going) return;
  ReplayOptions going_on = options;
  going_on.session.keep_going = true;
  try {
    SessionReport tried;
    tried.name = report.name;
    tried.session_folder = report.session_folder;
    OpenedSession opened;
    open_inputs(going_on, tried, opened);
  } catch (...) {
    return;
  }
  report.error += ", or leave it out with --keep-going";
}

void write_refusal(const SessionReport& report, const ReplayOptions& options) {
  const OutputFolder folder(options.out, report.session_folder);
  if (!folder.is_free()) return;
  const FolderLock lock = folder.prepare({}, EarlierResults::replace);
  write_whole_file(folder.summary_json(), json_text(summary_json(report, options)));
}

}  // namespace herr
