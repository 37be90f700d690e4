#include "server/check/check_progress.h"

#include <algorithm>
#include <cmath>

#include "server/check/report/check_report.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

std::string span_text(const PairDesign& design) {
  return std::to_string(design.looks.front()) + "–" + std::to_string(design.looks.back());
}

}  // namespace

std::string state_so_far(const Noise& noise, const Shift& shift) {
  if (!noise_text(noise).empty()) return "noisy so far";
  if (!std::isfinite(shift.lower) || !std::isfinite(shift.upper)) return "too early to tell";
  const std::string word = shift.lower > 0 ? "slower" : shift.upper < 0 ? "faster" : "same";
  return word + " so far (" + change_text(shift.estimate) + ")";
}

std::string pairs_text(int pairs, const PairDesign& design) {
  return std::to_string(pairs) + " of " + span_text(design) + " pairs";
}

std::string pair_progress(int pairs, const PairDesign& design, const std::string& state, double pair_seconds,
                          double seconds_left) {
  const int most = design.looks.back();
  const auto next = std::upper_bound(design.looks.begin(), design.looks.end(), pairs);
  const auto left = [&](int count) {
    return minutes_text(std::clamp(pair_seconds * (count - pairs), 0.0, std::max(seconds_left, 0.0)));
  };
  return "pair " + std::to_string(pairs) + " of " + span_text(design) + ", " + state + "; " +
         left(next == design.looks.end() ? most : *next) + " to " + left(most) + " left";
}

std::string run_progress(int runs, int of, const std::string& state, double run_seconds,
                         double seconds_left) {
  const double left = std::clamp(run_seconds * (of - runs), 0.0, std::max(seconds_left, 0.0));
  return "run " + std::to_string(runs) + " of " + std::to_string(of) + ", " + state + "; " +
         minutes_text(left) + " left";
}

}  // namespace herr
