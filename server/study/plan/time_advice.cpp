#include "server/study/plan/time_advice.h"

#include <algorithm>
#include <cmath>

#include "server/study/plan/reference_forecast.h"
#include "server/text/number_text.h"
#include "server/text/shell_word.h"

namespace herr {
namespace {

constexpr double kReport_s = 10;      // pictures and pages at the end
constexpr double kShareOfHalf = 0.5;  // of the minutes, for references

}  // namespace

std::string too_few_settings(const TimeShortage& shortage) {
  if (static_cast<double>(shortage.planned) >= kLeastShareForAdvice * static_cast<double>(shortage.settings))
    return {};
  std::string text = "--minutes " + shortest_text(shortage.minutes) + " is enough for " +
                     std::to_string(shortage.planned) + " of " + std::to_string(shortage.settings) +
                     " settings, too few for a recommendation; what helps, most first: ";
  if (shortage.only == 0) text += "--only with one or two names (herr study --help lists them); ";
  if (shortage.only > 1) text += "fewer names than " + std::to_string(shortage.only) + " in --only; ";
  if (!shortage.references.empty()) {
    text += "in the next study --references " + shell_word(shortage.references) + ", which took " +
            fixed_text(std::ceil(shortage.references_s), 0) + " s of this one; ";
  }
  if (shortage.profile_scale > kSmallScale) {
    text += "--profile-scale " + shortest_text(kSmallScale) + " (with references of its own); ";
  }
  return text + "--minutes " + fixed_text(shortage.minutes_needed, 0) +
         " or more, after this one with --resume";
}

double minutes_for(double minutes, double references_s, double rows_s, double more_s, bool all_frames) {
  const double rest_s = rows_s + more_s + kReport_s, half_s = std::max(references_s, rest_s) / kShareOfHalf;
  const double needed_s = all_frames ? std::max(references_s / kShareOfHalf, references_s + rest_s) : half_s;
  return std::max(std::ceil(minutes + 0.5), std::ceil(kReserve * needed_s / 60));
}

}  // namespace herr
