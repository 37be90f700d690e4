#include "server/study/stability/stability_progress.h"

#include <algorithm>

#include "server/process/steady_time.h"
#include "server/process/terminal.h"
#include "server/study/report/figure_text.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr std::size_t kStabilityBarWidth = 20;
constexpr std::size_t kLongestLine = 100;

double seconds_since(std::int64_t start_ns) {
  return static_cast<double>(steady_now_ns() - start_ns) * 1e-9;
}

}  // namespace

std::string stability_progress_text(std::size_t group, std::size_t groups, const std::string& what,
                                    double seconds) {
  const std::size_t filled = groups > 0 ? kStabilityBarWidth * (group - 1) / groups : 0;
  std::string text = "stability [" + std::string(filled, '#') +
                     std::string(kStabilityBarWidth - filled, '-') + "]  group " + std::to_string(group) +
                     " of " + std::to_string(groups) + "  ";
  const std::string end = "  " + fixed_figure(seconds, 0) + " s";
  std::string middle = printable(what);
  if (text.size() + middle.size() + end.size() > kLongestLine) {
    middle.resize(kLongestLine - std::min(kLongestLine, text.size() + end.size()));
  }
  return text + middle + end;
}

StabilityProgress::StabilityProgress(std::size_t groups)
    : drawn_(stderr_is_terminal()), groups_(groups), start_ns_(steady_now_ns()) {}

StabilityProgress::~StabilityProgress() {
  if (drawn_) print_progress("\r\033[K");
}

void StabilityProgress::draw(const std::string& what) const {
  if (!drawn_) return;
  print_progress("\r\033[K" +
                 stability_progress_text(group_, groups_, name_ + ": " + what, seconds_since(start_ns_)));
}

void StabilityProgress::begin_group(const RelationGroup& group) {
  end();
  ++group_;
  name_ = group.name;
  counts_ = {};
  group_start_ns_ = steady_now_ns();
  draw(group.sentence);
}

void StabilityProgress::tell(const RelationResult& result) {
  counts_.add(result);
  if (!result.holds()) {
    if (drawn_) print_progress("\r\033[K");
    print_message(failure_line(result));
  }
  draw("after " + result.relation.name);
}

void StabilityProgress::end() {
  if (!drawn_ && !name_.empty()) {
    print_message(name_ + ": " + counts_text(counts_) + " (" +
                  fixed_figure(seconds_since(group_start_ns_), 1) + " s)");
  }
  name_.clear();
}

}  // namespace herr
