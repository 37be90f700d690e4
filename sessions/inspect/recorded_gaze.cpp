#include "sessions/inspect/recorded_gaze.h"

#include <optional>
#include <utility>

#include "sessions/check/session_check.h"
#include "sessions/streams/row_stream.h"

namespace herr {

GazeSampler recorded_gaze(const std::filesystem::path& session_folder, const SessionHeader& header,
                          bool has_gaze) {
  GazeGeometry geometry{header.gaze_combined, header.vergence_m, {}};
  for (std::size_t eye = 0; eye < 2; ++eye) geometry.eye_in_head[eye] = header.head_from_eye[eye].position;
  std::optional<RowStream<GazeRow>> rows;
  if (has_gaze) {
    const SessionFiles files{session_folder};
    rows.emplace(files.gaze(), gaze_layout(), parse_gaze_row, RowPolicy{true, {}});
  }
  return {std::move(rows), SamplingMode::latest, geometry};
}

}  // namespace herr
