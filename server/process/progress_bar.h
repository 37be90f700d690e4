// One line that shows how far a run is: redrawn on a terminal; in a log a line every half minute.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace herr {

// The text of the bar, pure: "desk-walk [#####-----]  60/120  12.3 frames/s  ETA 0:05".
std::string progress_text(const std::string& label, std::int64_t done, std::int64_t total, double elapsed_s,
                          std::int64_t done_before = 0);

// The same for a log: "desk-walk: 60 of 120, 12.3 frames/s, 0:05 left".
std::string log_progress_text(const std::string& label, std::int64_t done, std::int64_t total,
                              double elapsed_s, std::int64_t done_before = 0);

class ProgressBar {
 public:
  // `done_before`: of the total, what was done before the bar began.
  ProgressBar(std::string label, std::int64_t total, std::int64_t done_before = 0);
  ~ProgressBar();  // clears the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // Redraws at most ten times a second; in a log the first line comes after half a minute.
  void update(std::int64_t done);

 private:
  using Clock = std::chrono::steady_clock;
  const bool shown_;
  const std::string label_;
  const std::int64_t total_, done_before_;
  const Clock::time_point start_;
  Clock::time_point last_drawn_;
};

}  // namespace herr
