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
