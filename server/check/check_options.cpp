#include "server/check/check_options.h"

#include <unistd.h>

#include "server/process/exit_code.h"
#include "server/settings/flag_values.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

// Before minutes of measuring, not after.
void check_place(const char* flag, const std::filesystem::path& file) {
  if (file.empty()) return;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!is_folder(folder)) {
    throw UsageError(std::string(flag) + ": there is no folder " + printable(folder.string()) +
                     "; make it first");
  }
  if (!may(W_OK | X_OK, folder) || is_folder(file)) {
    throw UsageError(std::string(flag) + ": " + printable(file.string()) +
                     " cannot be written; choose another place");
  }
}

// A gate that is asked to go red and stays green by mistake would be trusted.
void check_slow_down(const CheckOptions& options) {
  if (options.run.slow_down_percent <= 0) return;
  if (!options.save.empty()) {
    throw UsageError(
        "--slow-down: --save gives no verdict that it could change, and would store the slow runs; give it "
        "with "
        "--against or --baseline");
  }
  if (options.tiers == CheckedTiers::counters) {
    throw UsageError("--slow-down: has no effect on counters; leave --only counters out");
  }
}

void check_allowed_differences(const CheckOptions& options) {
  if (options.allowed.empty()) return;
  if (!options.save.empty()) {
    throw UsageError("--allow-different: --save compares nothing; give it with --baseline");
  }
  if (options.against.empty()) return;
  for (const DifferentPart part : {DifferentPart::scene, DifferentPart::session}) {
    if (!options.allowed.has(part)) continue;
    throw UsageError(std::string("--allow-different: with --against both builds render the same ") +
                     name_of(part) +
                     "; store runs of the other one with --save, then compare with --baseline");
  }
}

}  // namespace

void check_check_options(const CheckOptions& options) {
  if (options.run.replay.sessions.size() != 1) {
    throw UsageError("SESSION: check measures one session; run it once for each");
  }
  non_empty("SESSION", options.run.replay.sessions.front().native());
  if (options.measure) return;
  const int modes =
      (options.against.empty() ? 0 : 1) + (options.baseline.empty() ? 0 : 1) + (options.save.empty() ? 0 : 1);
  if (modes != 1) {
    throw UsageError(
        "check: give one of --against PROGRAM (another build), --save FILE (store runs) and --baseline FILE "
        "(compare with stored runs)");
  }
  check_slow_down(options);
  check_allowed_differences(options);
  check_place("--save", options.save);
  check_place("--junit", options.junit);
  check_place("--markdown", options.markdown);
  if (options.overwrite && options.save.empty()) throw UsageError("--overwrite: only --save writes a file");
  if (options.json && options.github_annotations) {
    throw UsageError(
        "--annotations: they stand on stdout, where --json puts one document; give one of the two");
  }
}

}  // namespace herr
