#include "sessions/import/head_at.h"

#include <algorithm>
#include <glm/common.hpp>

#include "sessions/streams/rotations.h"

namespace herr {
namespace {

// Between poses further apart than this, and than some usual steps, nobody knows where the head was.
constexpr double kWidestGapNs = 0.5e9;
constexpr double kWidestGapSteps = 4;
constexpr std::size_t kKeptForLateRows = 4096;

}  // namespace

HeadAt::HeadAt(const StreamFile& file, const HeadColumns& columns, const StampSurvey& survey, TimeNs shift_ns,
               std::size_t sort_rows)
    : cursor_(file, survey, shift_ns, true, stream_, warnings_),
      reader_(cursor_.rows(), columns),
      ordered_(cursor_, sort_rows, 0),
      most_kept_(sort_rows == 0 ? 2 : kKeptForLateRows),
      widest_gap_ns_(static_cast<TimeNs>(std::max(kWidestGapNs, kWidestGapSteps * survey.usual_step_ns))) {
  poses_.reserve(2 * most_kept_);
}

std::optional<Pose> HeadAt::operator()(TimeNs stamp_ns) {
  while (!ended_ && (poses_.empty() || poses_.back().stamp_ns < stamp_ns)) {
    PoseRow row;
    ended_ = !ordered_.next(row, [&](PoseRow& read) {
      const auto pose = reader_.read(cursor_.rows(), stream_.reading);
      if (pose) read.world_from_head = *pose;
      return pose.has_value();
    });
    if (ended_) break;
    if (poses_.size() == 2 * most_kept_)
      poses_.erase(poses_.begin(), poses_.end() - static_cast<std::ptrdiff_t>(most_kept_));
    poses_.push_back(row);
  }
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), stamp_ns,
                                      [](const PoseRow& row, TimeNs stamp) { return row.stamp_ns < stamp; });
  if (after == poses_.end()) return std::nullopt;
  if (after->stamp_ns == stamp_ns) return after->world_from_head;
  if (after == poses_.begin()) return std::nullopt;
  const auto before = after - 1;
  const TimeNs gap_ns = after->stamp_ns - before->stamp_ns;
  if (gap_ns > widest_gap_ns_) return std::nullopt;
  const double share = static_cast<double>(stamp_ns - before->stamp_ns) / static_cast<double>(gap_ns);
  const Pose& a = before->world_from_head;
  const Pose& b = after->world_from_head;
  return Pose{glm::mix(a.position, b.position, share), turn_from_to(a.orientation, b.orientation, share)};
}

}  // namespace herr
