// A build of herr that can be asked for a measured run in a fresh process: this one or another.
// Before: the command's options. After: one Measurement for each run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "server/check/measure/measurement.h"
#include "server/check/measure/time_limit.h"

namespace herr {

// This program's own run ended with an error: the whole check ends with its exit code and message.
class RunFailed : public std::runtime_error {
 public:
  RunFailed(int exit_code, const std::string& message) : std::runtime_error(message), code_(exit_code) {}
  int exit_code() const { return code_; }

 private:
  int code_;
};

class MeasuredProgram {
 public:
  // The running program itself; `arguments` name session and settings.
  static MeasuredProgram this_one(std::vector<std::string> arguments);
  // Throws UsageError when the file cannot be run.
  static MeasuredProgram other(const std::filesystem::path& program, std::vector<std::string> arguments);

  // One run of at most `frames` frames. Throws RunFailed when this program fails or a signal asks for the
  // end, NotComparable when another program cannot do it, OutOfTime when it does not end within the limit.
  Measurement measure(std::int64_t frames, const TimeLimit& limit) const;

 private:
  MeasuredProgram(std::filesystem::path program, std::vector<std::string> arguments, bool is_other);

  std::filesystem::path program_;
  std::vector<std::string> arguments_;
  bool is_other_;
};

}  // namespace herr
