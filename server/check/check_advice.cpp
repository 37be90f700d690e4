#include "server/check/check_advice.h"

#include <cmath>

#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr double kRoom = 1.2;      // a machine may be slower next time
constexpr double kRounded_s = 10;  // a number to type

std::string count_text(int count, const MoreRuns& more) {
  return std::to_string(count) + " more " + (count == 1 ? more.one : more.several);
}

}  // namespace

std::string more_runs_advice(const MoreRuns& more) {
  const double seconds = kRoom * (more.used_s + more.most * more.seconds_each);
  const std::string value = fixed_text(kRounded_s * std::ceil(seconds / kRounded_s), 0);
  return "it takes " + count_text(more.fewest, more) +
         (more.fewest < more.most ? " at least, " + std::to_string(more.most) + " at most" : "") +
         ": --max-seconds " + value;
}

std::string noisy_advice(const Noise& noise, const char* several) {
  const std::string none = std::string("no number of ") + several + " helps: ";
  if (std::isnan(noise.steal)) return none + "take --only counters, or a machine whose kernel tells";
  return none + "repeat it when the machine is quieter, or take --only counters";
}

std::string longer_runs_advice(std::optional<std::int64_t> frames, double run_seconds) {
  return "all pairs are done, and longer runs tell more: " +
         (frames ? "--frames " + std::to_string(2 * *frames)
                 : "--run-seconds " + shortest_text(2 * run_seconds));
}

}  // namespace herr
