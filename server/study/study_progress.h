// What a study is at, on a terminal: how much of its time is used, and what is measured. Silent elsewhere.
// Before: study_run. After: stderr.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace herr {

// Pure: "study [#####-----]  35/210  polar 788x768, N = 1, frame 2 of 3  8:12 of at most 20:00".
std::string study_progress_text(std::size_t done, std::size_t total, const std::string& what, double seconds,
                                double limit_s);

class StudyProgress {
 public:
  explicit StudyProgress(double limit_s);
  ~StudyProgress();  // clears the line
  StudyProgress(const StudyProgress&) = delete;
  StudyProgress& operator=(const StudyProgress&) = delete;

  void expect(std::size_t total) { total_ = total, done_ = 0; }
  void count() { ++done_; }
  void tell(const std::string& what, double seconds);

 private:
  const bool shown_;
  const double limit_s_;
  std::size_t done_ = 0, total_ = 0;
};

}  // namespace herr
