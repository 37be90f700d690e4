#include "server/process/progress_bar.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "server/process/terminal.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr int kBarWidth = 30;
constexpr auto kRedrawInterval = std::chrono::milliseconds(100);
constexpr auto kLogInterval = std::chrono::seconds(30);

}  // namespace

std::string progress_text(const std::string& label, std::int64_t done, std::int64_t total, double elapsed_s,
                          std::int64_t done_before) {
  const double share = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 1.0;
  const auto filled = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * kBarWidth);
  std::string text = label + " [" + std::string(filled, '#') + std::string(kBarWidth - filled, '-') + "]  " +
                     std::to_string(done) + "/" + std::to_string(total);
  if (done > done_before && elapsed_s > 0) {
    const double rate = static_cast<double>(done - done_before) / elapsed_s;
    text += "  " + fixed_text(rate, 1) + " frames/s  ETA " +
            minutes_text(static_cast<double>(total - done) / rate);
  }
  return text;
}

std::string log_progress_text(const std::string& label, std::int64_t done, std::int64_t total,
                              double elapsed_s, std::int64_t done_before) {
  std::string text = label + ": " + std::to_string(done) + " of " + std::to_string(total);
  if (done <= done_before || !(elapsed_s > 0)) return text;
  const double rate = static_cast<double>(done - done_before) / elapsed_s;
  return text + ", " + fixed_text(rate, 1) + " frames/s, " +
         minutes_text(static_cast<double>(total - done) / rate) + " left";
}

ProgressBar::ProgressBar(std::string label, std::int64_t total, std::int64_t done_before)
    : shown_(stderr_is_terminal()),
      label_(printable(label)),
      total_(total),
      done_before_(done_before),
      start_(Clock::now()),
      last_drawn_(start_ - kRedrawInterval) {}

ProgressBar::~ProgressBar() {
  if (shown_) print_progress(kClearLine);
}

void ProgressBar::update(std::int64_t done) {
  const Clock::time_point now = Clock::now();
  if (shown_ ? now - last_drawn_ < kRedrawInterval : now - last_drawn_ < kLogInterval) return;
  last_drawn_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  if (!shown_) {
    print_message(log_progress_text(label_, done, total_, elapsed_s, done_before_));
    return;
  }
  print_progress(kClearLine + progress_text(label_, done, total_, elapsed_s, done_before_));
}

}  // namespace herr
