// Poses of the head at the stamps of another stream, for gaze that was recorded in the world.
// Before: a second pass over the head's file, in step with the gaze. After: import_rows.
// Memory: the poses around the stamp, and as many before it as rows may come late.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sessions/import/ordered_rows.h"
#include "sessions/import/rows/head_reader.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

class HeadAt {
 public:
  // All of them must outlive it. Throws InputError.
  HeadAt(const StreamFile& file, const HeadColumns& columns, const StampSurvey& survey, TimeNs shift_ns,
         std::size_t sort_rows);
  // Stamps grow, or come at most as late as rows may. Between two poses it turns and moves evenly; none
  // outside the poses' span, and where tracking was lost for long. Bad rows are passed over: the poses'
  // import tells them.
  std::optional<Pose> operator()(TimeNs stamp_ns);

 private:
  ImportedStream stream_;
  std::vector<std::string> texts_;
  Warnings warnings_{texts_};
  StreamCursor cursor_;
  HeadReader reader_;
  OrderedRows<PoseRow> ordered_;
  std::size_t most_kept_;
  TimeNs widest_gap_ns_;
  std::vector<PoseRow> poses_;
  bool ended_ = false;
};

}  // namespace herr
