// Another program run to its end, with what it said. Before: a command line. After: measured_program reads
// the record on its stdout.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/process/exit_code.h"

namespace herr {

class TookTooLong : public TemporaryError {
 public:
  using TemporaryError::TemporaryError;
};

struct ProcessOutcome {
  int exit_code = 0;  // 128 + n where signal n ended it
  std::string out, err;
};

// Waits for its end and reads both outputs meanwhile. The program is killed when this process is asked to
// stop (stop_signal()) or when it takes longer than `most_seconds`; the latter throws TookTooLong. Throws
// std::system_error when it cannot be started.
ProcessOutcome run_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                           double most_seconds);

}  // namespace herr
