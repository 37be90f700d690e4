#include "server/study/stability/stability_command.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/process/exit_code.h"
#include "server/process/steady_time.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/results/summary_json.h"
#include "server/settings/option_checks.h"
#include "server/study/relations/recording_folder.h"
#include "server/study/stability/report/stability_json.h"
#include "server/study/stability/report/stability_page.h"
#include "server/study/stability/report/stability_text.h"
#include "server/study/stability/report/stability_verdict.h"
#include "server/study/stability/stability_case.h"
#include "server/study/stability/stability_folder.h"
#include "server/study/stability/stability_progress.h"
#include "server/study/stability/stability_record_of.h"
#include "server/study/stability/stability_run.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

std::optional<std::vector<RelationResult>> ask(const std::vector<RelationGroup>& groups,
                                               const RelationCase& subject) {
  StabilityProgress progress(groups.size());
  const StabilityEars ears{[&](const RelationGroup& group) { progress.begin_group(group); },
                           [&](const RelationResult& result) { progress.tell(result); }};
  std::optional<std::vector<RelationResult>> results =
      measure_groups(groups, subject, ears, [] { return stop_signal() != 0; });
  progress.end();
  return results;
}

}  // namespace

int run_stability(const StudyOptions& options) {
  const std::vector<RelationGroup> groups = wanted_groups(options.only);
  check_render_settings(options.render);
  { const RecordingFolder relations_can_make_recordings; }  // before minutes are spent
  const TimeNs start_ns = steady_now_ns();
  const StabilityCase subject(options);
  const StabilityFolder folder(options.out_folder());
  const FolderLock lock = folder.prepare(options.overwrite);
  std::optional<std::vector<RelationResult>> results = ask(groups, subject.relations());
  if (!results) {
    print_message("stopped; nothing is written");
    return kExitSignalBase + stop_signal();
  }
  const StabilityRecord record = stability_record_of(options, subject, std::move(*results),
                                                     static_cast<double>(steady_now_ns() - start_ns) * 1e-9);
  const std::string json = json_text(stability_json(record));
  write_whole_file(folder.json(), json);
  write_whole_file(folder.page(), stability_page(record));
  sync_folder(folder.path());
  print_result(options.json ? json : stability_text(record));
  print_message("report: " + printable(folder.page().string()));
  return stability_exit_code(record.results);
}

}  // namespace herr
