// Cuts the stamps of a stream into runs that one clock wrote without a jump, and chooses those that make one
// recording: the increasing chain of runs with the most rows.
// Before: stamp_survey feeds stamps. After: stamp_survey names what was left out. Memory: at most kMost runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sessions/format/pose.h"
#include "sessions/import/stamps/stamp_survey.h"

namespace herr {

struct StampRun {
  enum class Start { back, ahead, far_ahead };  // of the newest stamp of the run before
  Start start = Start::ahead;
  RowPlace first, last;
  std::int64_t rows = 0;
  TimeNs first_ns = 0, lowest_ns = 0, highest_ns = 0;
  bool kept = false;
};

class StampRuns {
 public:
  static constexpr std::size_t kMost = 1000;  // runs
  static constexpr std::size_t kMostLeftOut = 10000;
  static constexpr std::int64_t kWildRows = 3;  // a shorter run far from its neighbours is no recording

  // `sort_rows`: that many usual steps back are no jump.
  StampRuns(double usual_step_ns, std::size_t sort_rows);
  void add(TimeNs stamp_ns, const RowPlace& place);
  // To be called once, at the end: chooses the runs that stay and adds the others to left_out().
  void choose();

  const std::vector<StampRun>& runs() const { return runs_; }
  std::vector<LeftOutRows>& left_out() { return left_out_; }
  // The stamps jump so often that nothing was chosen.
  bool too_many() const { return too_many_; }
  bool far(TimeNs from_ns, TimeNs to_ns) const { return to_ns - from_ns > far_ns_; }

 private:
  void jump(TimeNs stamp_ns, const RowPlace& place);
  bool returns(TimeNs stamp_ns, const RowPlace& place);
  void extend(StampRun& run, TimeNs stamp_ns, const RowPlace& place) const;
  void merge_hitches();
  void choose_chain();
  void drop_lone_rows();

  double usual_step_ns_;
  TimeNs near_ns_, far_ns_;
  bool too_many_ = false;
  std::vector<StampRun> runs_;
  std::vector<LeftOutRows> left_out_;
};

}  // namespace herr
