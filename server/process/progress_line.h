// One line on stderr that says how a long run stands: rewritten on a terminal; in a log, where every line
// stays, printed sparingly. Before: a loop that takes seconds a turn. After: stderr.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace herr {

class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();  // clears the line of a terminal
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // In a log the first text is printed, each one that is `worth_a_line`, and any other only where half a
  // minute has passed since the last.
  void show(const std::string& text, bool worth_a_line = false);

 private:
  using Clock = std::chrono::steady_clock;
  const bool on_terminal_;
  std::optional<Clock::time_point> last_shown_;
};

}  // namespace herr
