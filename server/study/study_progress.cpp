#include "server/study/study_progress.h"

#include <algorithm>
#include <cstdint>

#include "server/process/terminal.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr int kStudyBarWidth = 20;
constexpr std::size_t kLongestText = 100;

std::string clock_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds);
  const std::string rest = std::to_string(whole % 60);
  return std::to_string(whole / 60) + ":" + (rest.size() < 2 ? "0" : "") + rest;
}

}  // namespace

std::string study_progress_text(std::size_t done, std::size_t total, const std::string& what, double seconds,
                                double limit_s) {
  const double share = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 0.0;
  const auto filled = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * kStudyBarWidth);
  std::string text = "study [" + std::string(filled, '#') + std::string(kStudyBarWidth - filled, '-') + "]";
  if (total > 0) text += "  " + std::to_string(done) + "/" + std::to_string(total);
  const std::string end = "  " + clock_text(seconds) + " of at most " + clock_text(limit_s);
  std::string middle = "  " + printable(what);
  if (text.size() + middle.size() + end.size() > kLongestText) {
    middle.resize(kLongestText - std::min(kLongestText, text.size() + end.size()));
  }
  return text + middle + end;
}

StudyProgress::StudyProgress(double limit_s) : shown_(stderr_is_terminal()), limit_s_(limit_s) {}

StudyProgress::~StudyProgress() {
  if (shown_) print_progress("\r\033[K");
}

void StudyProgress::tell(const std::string& what, double seconds) {
  if (shown_) print_progress("\r\033[K" + study_progress_text(done_, total_, what, seconds, limit_s_));
}

}  // namespace herr
