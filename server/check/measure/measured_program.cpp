#include "server/check/measure/measured_program.h"

#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "server/check/measure/child_process.h"
#include "server/check/measure/not_comparable.h"
#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

constexpr double kMostRunSeconds = 900;

// The last line of what a program said, without its name before it.
std::string last_message(const std::string& err) {
  const std::size_t end = err.find_last_not_of('\n');
  if (end == std::string::npos) return "no message";
  const std::size_t start = err.find_last_of('\n', end);
  std::string line = err.substr(start == std::string::npos ? 0 : start + 1, end + 1);
  line = line.substr(0, line.find('\n'));
  return line.starts_with("herr: ") ? line.substr(6) : line;
}

ProcessOutcome run_within(const std::filesystem::path& program, const std::vector<std::string>& words,
                          const TimeLimit& limit) {
  const double left = limit.seconds_left();
  if (left <= 0) throw OutOfTime();
  try {
    return run_process(program, words, std::min(left, kMostRunSeconds));
  } catch (const TookTooLong&) {
    if (left < kMostRunSeconds) throw OutOfTime();
    throw;
  }
}

}  // namespace

MeasuredProgram::MeasuredProgram(std::filesystem::path program, std::vector<std::string> arguments,
                                 bool is_other)
    : program_(std::move(program)), arguments_(std::move(arguments)), is_other_(is_other) {}

MeasuredProgram MeasuredProgram::this_one(std::vector<std::string> arguments) {
  return {std::filesystem::read_symlink("/proc/self/exe"), std::move(arguments), false};
}

MeasuredProgram MeasuredProgram::other(const std::filesystem::path& program,
                                       std::vector<std::string> arguments) {
  if (!is_file(program) || !may(X_OK, program)) {
    throw UsageError("--against: " + printable(program.string()) +
                     " is no program; name another build of herr");
  }
  return {std::filesystem::absolute(program), std::move(arguments), true};
}

Measurement MeasuredProgram::measure(std::int64_t frames, const TimeLimit& limit) const {
  std::vector<std::string> words{"check", "--measure", "--frames", std::to_string(frames)};
  words.insert(words.end(), arguments_.begin(), arguments_.end());
  const ProcessOutcome outcome = run_within(program_, words, limit);
  if (const int signal = stop_signal(); signal != 0) {
    throw RunFailed(kExitSignalBase + signal, "ended by signal " + std::to_string(signal));
  }
  const std::string name = is_other_ ? printable(program_.string()) : "this program";
  if (outcome.exit_code != kExitDone) {
    const std::string message = last_message(outcome.err);
    if (!is_other_) throw RunFailed(outcome.exit_code, message);
    throw NotComparable(name + " cannot measure this (exit code " + std::to_string(outcome.exit_code) +
                        "): " + message);
  }
  try {
    return read_measurement(parse_json_text(outcome.out, name, 1), name);
  } catch (const InputError& error) {
    if (!is_other_) throw;
    throw NotComparable(name + " measures in another format: " + error.what());
  }
}

}  // namespace herr
