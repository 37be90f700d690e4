#include "server/process/progress_line.h"

#include "server/process/terminal.h"

namespace herr {
namespace {

constexpr auto kQuietInLog = std::chrono::seconds(30);

}  // namespace

ProgressLine::ProgressLine() : on_terminal_(stderr_is_terminal()) {}

ProgressLine::~ProgressLine() {
  if (on_terminal_ && last_shown_) print_progress(kClearLine);
}

void ProgressLine::show(const std::string& text, bool worth_a_line) {
  const Clock::time_point now = Clock::now();
  const bool due = !last_shown_ || worth_a_line || now - *last_shown_ >= kQuietInLog;
  if (!on_terminal_ && !due) return;
  last_shown_ = now;
  if (on_terminal_) {
    print_progress(kClearLine + text);
  } else {
    print_message(text);
  }
}

}  // namespace herr
