// One stream of a recording as a whole: rows, rate, jitter, the longest gaps. Bounded memory.
// Before: the pass over the session. After: findings and the table of streams.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sessions/inspect/findings.h"
#include "sessions/inspect/frame_ages.h"
#include "sessions/streams/interval_census.h"

namespace herr {

// An interval that is much longer than the usual one.
struct StreamGap {
  TimeNs length_ns = 0, end_ns = 0;
  std::int64_t end_line = 0;

  bool operator==(const StreamGap&) const = default;
};

struct StreamSummary {
  std::string name;  // "pose", "gaze", "cam0", "cam1"
  std::filesystem::path file;
  double nominal_hz = 0;  // of session.json; 0: not stated
  std::int64_t rows = 0;
  TimeNs first_ns = 0, last_ns = 0;
  IntervalCensus intervals;
  std::int64_t repeated_values = 0;  // rows that say the same as the row before
  bool stillness_told = false;       // another finding tells it where all rows say the same
  std::optional<FrameAges> ages;     // none where the span of the poses is not known

  // A good row; stamps grow.
  void count(TimeNs stamp_ns, std::int64_t line, bool repeats);

  double span_s() const { return static_cast<double>(last_ns - first_ns) * kSecondsPerNs; }
  // 0 with less than two rows.
  double median_hz() const;
  double mean_hz() const;
  // Intervals of more than kHitchIntervals medians, longest first; at most kMostGaps.
  std::vector<StreamGap> longest_gaps() const;

  static constexpr std::size_t kMostGaps = 8;

 private:
  std::vector<StreamGap> longest_;  // intervals of any length, longest first
};

// That rows are too rare for a head's: the unit of time is wrong. Without a full stop; empty where they are
// not.
std::string rarity(const IntervalCensus& intervals);

// Findings about gaps, repeated values and the stated rate. `poses`: of the same recording; may be `stream`.
void judge_stream(const StreamSummary& poses, const StreamSummary& stream, FindingList& findings);

// How the stamps of a stream lie to those of the poses.
struct StreamOffset {
  TimeNs start_ns = 0, end_ns = 0;  // its first (last) stamp minus that of the poses
  TimeNs change_ns = 0;             // end minus start: the one clock's gain on the other
  TimeNs resolution_ns = 0;         // one median interval of each: what start and stop alone can shift it
  // Gain per second of the poses in 1e-6. None when the change is within the resolution (no drift can be
  // told), or so large that one stream started or stopped at another time.
  std::optional<double> drift_ppm;
};
StreamOffset offset_to(const StreamSummary& poses, const StreamSummary& stream);
// A finding where the stream starts or ends more than a second apart from the poses, or seems to drift.
void judge_offset(const StreamSummary& poses, const StreamSummary& stream, FindingList& findings);

}  // namespace herr
