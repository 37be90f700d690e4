#include "server/inspect/central_moments.h"

#include <algorithm>
#include <cmath>

#include "sessions/check/session_check.h"
#include "sessions/streams/row_stream.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

void find_central_moments(const std::filesystem::path& session_folder, TimeNs start_ns,
                          std::vector<SceneObject>& objects) {
  auto left = std::count_if(objects.begin(), objects.end(),
                            [](const SceneObject& object) { return object.most_central.has_value(); });
  if (left == 0) return;
  const SessionFiles files{session_folder};
  RowStream<PoseRow> rows(files.pose(), pose_layout(), parse_pose_row, RowPolicy{true, {}});
  while (left > 0) {
    const std::optional<PoseRow> row = rows.next();
    if (!row) return;
    if (row->stamp_ns < start_ns) continue;
    for (SceneObject& object : objects) {
      const bool is_it = object.most_central && !object.most_central_s &&
                         object.most_central->position == row->world_from_head.position &&
                         object.most_central->orientation == row->world_from_head.orientation;
      if (!is_it) continue;
      object.most_central_s = std::floor(static_cast<double>(row->stamp_ns - start_ns) * 1e-8) / 10;
      --left;
    }
  }
}

}  // namespace herr
