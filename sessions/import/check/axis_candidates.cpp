#include "sessions/import/check/axis_candidates.h"

#include <algorithm>
#include <utility>

#include "sessions/import/presets/choose_format.h"

namespace herr {

void set_head_axes(ColumnMap& map, std::size_t convention) {
  const AxisConvention& axes = axis_conventions()[convention];
  HeadColumns& head = map.head.front();
  head.world_axes = directions(axes.world);
  head.head_axes = directions(axes.head);
}

AxisCandidate tried(const RecordingFiles& files, ColumnMap map, std::size_t reading, std::size_t convention,
                    bool with_gaze) {
  AxisCandidate candidate;
  candidate.reading = reading;
  candidate.convention = convention;
  candidate.map = std::make_shared<const ColumnMap>(std::move(map));
  FormatRequest request;
  request.files = files;
  if (!with_gaze) request.files.gaze.reset();
  const bool gaze = with_gaze && !candidate.map->gaze.empty();
  const ImportColumns columns{&candidate.map->head.front(), gaze ? &candidate.map->gaze.front() : nullptr};
  candidate.trial = trial_import(import_request(request, columns));
  return candidate;
}

std::vector<const AxisCandidate*> remaining(const std::vector<AxisCandidate>& candidates) {
  std::vector<const AxisCandidate*> left;
  for (const AxisCandidate& one : candidates)
    if (one.against.empty() && std::none_of(left.begin(), left.end(), [&](const AxisCandidate* other) {
          return other->trial.rows_hash == one.trial.rows_hash;
        }))
      left.push_back(&one);
  return left;
}

}  // namespace herr
