#include "server/check/report/check_report.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>

#include "server/process/exit_code.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr int kMostToldOfAPart = 3;  // the rest is counted; JSON has all

std::string signed_percent(double share) {
  return (share >= 0 ? "+" : "") + fixed_text(100 * share, 1) + " %";
}

}  // namespace

int exit_code_of(Verdict verdict) {
  if (verdict == Verdict::ok) return kExitDone;
  return verdict == Verdict::regression ? kExitRegression : kExitInconclusive;
}

std::string change_text(double logarithm) {
  return signed_percent(std::expm1(logarithm));
}

std::string bounds_text(const Shift& shift) {
  const bool lower = std::isfinite(shift.lower), upper = std::isfinite(shift.upper);
  if (lower && upper) return change_text(shift.lower) + " ... " + change_text(shift.upper);
  if (lower) return change_text(shift.lower) + " at least";
  return upper ? change_text(shift.upper) + " at most" : "none, too few runs";
}

std::string counter_change_text(const CounterJudgement& counter) {
  if (counter.baseline == counter.candidate) return "0";
  return counter.baseline > 0 ? signed_percent(counter.candidate / counter.baseline - 1) : "from 0";
}

std::string slower_text(double logarithm) {
  const double share = std::expm1(logarithm);
  return "frames take " + fixed_text(100 * std::abs(share), 1) + " % " + (share < 0 ? "less" : "more") +
         " time";
}

std::string open_text(const Shift& shift) {
  const bool bounded = std::isfinite(shift.lower) || std::isfinite(shift.upper);
  return slower_text(shift.estimate) +
         (bounded ? ", by the bounds " + bounds_text(shift) : ", too few runs for bounds") +
         ": too little to tell";
}

std::string p_text(double p) {
  return p < 1e-5 ? "< 0.00001" : fixed_text(p, 5);
}

std::string with_remarks(const std::string& finding, const CheckReport& report, Verdict verdict,
                         bool of_times) {
  const bool open = verdict == Verdict::noisy || verdict == Verdict::inconclusive;
  std::string text = finding;
  for (const std::string& more :
       {of_times ? report.ended_early : std::string(), of_times && open ? report.advice : std::string(),
        differences_text(report)}) {
    if (!more.empty()) text += (text.empty() ? "" : "; ") + more;
  }
  return text;
}

std::string differences_text(const CheckReport& report) {
  std::string text;
  const std::vector<AllowedDifference> parts = differences_by_part(report);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    text += (i == 0 ? "" : i + 1 < parts.size() ? ", " : " and ") + parts[i].part;
  }
  const bool one = parts.size() == 1 && !parts.front().part.ends_with('s');
  return parts.empty() ? text : text + (one ? " differs, as allowed" : " differ, as allowed");
}

std::vector<AllowedDifference> differences_by_part(const CheckReport& report) {
  std::vector<AllowedDifference> parts;
  std::vector<int> counts;
  for (const AllowedDifference& difference : report.differences) {
    if (parts.empty() || parts.back().part != difference.part) {
      parts.push_back({difference.part, ""});
      counts.push_back(0);
    }
    if (++counts.back() > kMostToldOfAPart) continue;
    parts.back().text += (parts.back().text.empty() ? "" : "; ") + difference.text;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (counts[i] > kMostToldOfAPart)
      parts[i].text += "; and " + std::to_string(counts[i] - kMostToldOfAPart) + " more";
  }
  return parts;
}

std::string headline(const CheckReport& report) {
  std::string word = report.error.empty() ? name_of(report.verdict) : "error";
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const std::string& why = report.error.empty() ? report.reason : report.error;
  return word + (why.empty() ? "" : ": " + why);
}

}  // namespace herr
