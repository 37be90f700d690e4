// How the streams of a session are read at a time, and what happens to rows and pictures that are wrong.
#pragma once

namespace herr {

enum class SamplingMode { latest, predict, interpolate };

struct SessionOptions {
  SamplingMode sampling = SamplingMode::latest;  // latest: the newest sample at or before the time (causal)
  double predict_cap_s = 0.1;                    // predict: never extrapolate further than this
  bool keep_going = false;                       // skip and count bad rows and images instead of throwing
  bool strict = false;  // a stream whose last line was cut off is an error, not a warning
};

}  // namespace herr
