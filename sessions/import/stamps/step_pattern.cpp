#include "sessions/import/stamps/step_pattern.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace herr {
namespace {

constexpr double kClose = 0.1;            // of the step from group to group: within a group
constexpr double kThinBelow = 0.25;       // likewise: the whole group is narrower than this
constexpr std::size_t kMostCameras = 4;   // more rows at once are a logger that writes in bursts
constexpr std::size_t kFewestGroups = 5;  // fewer say nothing
constexpr double kRegular = 0.95;         // share of the groups that no more rows than cameras are in

// The step at a share of the sorted steps.
double at_share(const std::vector<TimeNs>& sorted, double share) {
  const auto place = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return static_cast<double>(sorted[std::min(place, sorted.size() - 1)]);
}

// The largest number of stamps that a good part of the groups has; 0 where groups have any number.
int stamps_in_groups(std::span<const TimeNs> stamps, double limit_ns) {
  std::array<std::size_t, kMostCameras + 2> groups_of{};  // by size; the last: larger
  std::size_t groups = 0, size = 0;
  bool first = true;  // may be a part of a group
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    ++size;
    if (static_cast<double>(stamps[i] - stamps[i - 1]) < limit_ns) continue;
    if (!first) {
      ++groups_of[std::min(size, kMostCameras + 1)];
      ++groups;
    }
    first = false;
    size = 0;
  }
  if (groups < kFewestGroups) return 0;
  const auto share = [&](std::size_t many) {
    return static_cast<double>(many) / static_cast<double>(groups);
  };
  if (share(groups_of.back()) > 1 - kRegular) return 0;
  for (std::size_t cameras = kMostCameras; cameras > 1; --cameras)
    if (share(groups_of[cameras]) > 1 - kRegular) return static_cast<int>(cameras);
  return 0;
}

}  // namespace

StepPattern step_pattern(std::span<const TimeNs> stamps) {
  std::vector<TimeNs> steps;
  for (std::size_t i = 1; i < stamps.size(); ++i)
    if (stamps[i] > stamps[i - 1]) steps.push_back(stamps[i] - stamps[i - 1]);
  StepPattern pattern;
  if (steps.empty()) return pattern;
  std::sort(steps.begin(), steps.end());
  pattern.usual_ns = at_share(steps, 0.5);
  // Four cameras make a quarter of the steps wide ones.
  const double limit_ns = kClose * at_share(steps, 0.9);
  const auto first_wide =
      std::lower_bound(steps.begin(), steps.end(), limit_ns,
                       [](TimeNs step, double limit) { return static_cast<double>(step) < limit; });
  const auto close = static_cast<double>(first_wide - steps.begin());
  if (close < kCloseShare * static_cast<double>(steps.size())) return pattern;
  pattern.cameras = stamps_in_groups(stamps, limit_ns);
  if (pattern.cameras == 0) return pattern;
  pattern.within_ns = at_share({steps.begin(), first_wide}, 0.5);
  pattern.usual_ns = at_share({first_wide, steps.end()}, 0.5);
  pattern.thin_below_ns = static_cast<TimeNs>(kThinBelow * pattern.usual_ns);
  return pattern;
}

}  // namespace herr
