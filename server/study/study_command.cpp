#include "server/study/study_command.h"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/results/summary_json.h"
#include "server/settings/option_checks.h"
#include "server/study/export_sequences.h"
#include "server/study/plan/only_sweeps.h"
#include "server/study/report/study_json.h"
#include "server/study/report/study_page.h"
#include "server/study/report/study_text.h"
#include "server/study/study_folder.h"
#include "server/study/study_record_of.h"
#include "server/study/study_run.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

// Before minutes are spent.
void prepare_folders(const StudyOptions& options) {
  std::error_code none_there;
  if (!options.export_to.empty() && !list_folder(options.export_to, none_there).empty()) {
    throw UsageError("--export: " + printable(options.export_to.string()) +
                     " is not empty; choose another folder");
  }
  if (options.references.empty()) return;
  if (const std::error_code failed = make_folders(options.references)) {
    throw UsageError("--references: " + printable(options.references.string()) +
                     " cannot be made: " + failed.message());
  }
}

}  // namespace

int run_study(const StudyOptions& options) {
  const TimeNs started_ns = steady_now_ns();
  check_render_settings(options.render);
  prepare_folders(options);
  StudySubject subject(options);
  StudySweeps sweeps = sweeps_of(subject.defaults(),
                                 [&](const RenderSettings& settings) { return subject.plan_of(settings); });
  keep_only(options.only, sweeps);
  const StudyFolder folder(options.out_folder());
  const FolderLock lock = folder.prepare(options.overwrite, options.resume);
  StudyRun run(options, subject, std::move(sweeps), folder, started_ns);
  if (!run.measure()) {
    print_message("stopped after " + counted(static_cast<std::int64_t>(run.rows().size()), "row", "rows") +
                  "; go on with --resume");
    return kExitSignalBase + stop_signal();
  }
  const StudyRecord record = record_of(options, subject, run);
  write_whole_file(folder.json(), json_text(study_json(record)));
  write_whole_file(folder.page(), study_page(record));
  sync_folder(folder.path());
  if (!options.export_to.empty()) export_sequences(options, subject, run);
  print_result(options.json ? json_text(study_json(record)) : study_text(record));
  print_message("report: " + printable(folder.page().string()));
  return kExitDone;
}

}  // namespace herr
