#include "server/check/check_options.h"

#include "server/cli/exit_code.h"
#include "server/cli/flags.h"

namespace herr {

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
  if (options.overwrite && options.save.empty()) throw UsageError("--overwrite: only --save writes a file");
  if (options.json && options.github_annotations) {
    throw UsageError(
        "--annotations: they stand on stdout, where --json puts one document; give one of the two");
  }
}

}  // namespace herr
