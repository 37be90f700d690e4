// Where the eyes look at any time. Gaze is never extrapolated: eyes jump. What is missing is held, then let
// go. Before: RowStream<GazeRow>. After: Session::sample. Every answer depends on the last valid rows and
// their age alone, not on when else the sampler was asked, so that any frame rate sees the same eyes.
#pragma once

#include <array>
#include <optional>

#include "sessions/format/session_header.h"
#include "sessions/streams/frame_sample.h"
#include "sessions/streams/row_stream.h"
#include "sessions/streams/session_options.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

// A lost gaze stays where it was last seen: most blinks last 100 to 400 ms and end near where they began.
inline constexpr TimeNs kGazeHoldNs = 600'000'000;
// After that its angle to the centre shrinks by exp(-dt / tau): 60 degrees are 0.08 after one second.
inline constexpr double kGazeGlideTauS = 0.15;
// From here on (60 degrees have become 0.003, a sixth of the finest display pixel) it is called centred.
inline constexpr TimeNs kGazeCentredNs = kGazeHoldNs + 1'500'000'000;

struct GazeGeometry {
  bool combined = false;
  std::optional<double> vergence_m;
  std::array<glm::dvec3, 2> eye_in_head{};
};

class GazeSampler {
 public:
  GazeSampler(std::optional<RowStream<GazeRow>> rows, SamplingMode mode, const GazeGeometry& geometry);
  // Times must not decrease.
  SampledGaze at(TimeNs t_ns);

 private:
  struct Seen {
    TimeNs stamp_ns = 0;
    glm::dvec3 head_direction{0, 0, -1};
  };
  struct EyeSample {
    glm::dvec3 head_direction{0, 0, -1};
    SampleSource source = SampleSource::centred;
    std::optional<TimeNs> stamp_ns;  // of the row used
  };
  std::optional<GazeRow> next_row();
  void take(const GazeRow& row);
  EyeSample eye_at(std::size_t eye, TimeNs t_ns) const;
  std::optional<EyeSample> interpolated(std::size_t eye, TimeNs t_ns) const;
  glm::dvec3 aimed(std::size_t eye, const glm::dvec3& ray) const;

  std::optional<RowStream<GazeRow>> rows_;
  SamplingMode mode_;
  GazeGeometry geometry_;
  std::array<std::optional<Seen>, 2> seen_;  // last valid row of each eye at or before the time
  TimeNs newest_ns_ = -1;                    // stamp of the newest row at or before the time, valid or not
  std::optional<GazeRow> after_;             // first row after the time
};

}  // namespace herr
