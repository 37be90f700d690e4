// Which settings no other one beats in both error and time, and how sure that is. Before: errors per frame
// and paired log ratios of each setting. After: front and recommendation of the report.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace herr {

struct FrontCandidate {
  std::vector<double> frame_errors;  // one for each frame, the same frames in the same order for all; > 0
  std::vector<double> log_ratios;    // of time to the default
};

struct FrontPlace {
  bool on_front = false;  // root mean square of its errors and median of its ratios
  double confidence = 0;  // share of bootstrap draws in which it is on the front
};

// `draws` resamples frames (the same ones for all candidates: they share what makes a frame hard) and each
// candidate's ratios (Efron, "Bootstrap methods", 1979). A candidate is beaten by one that is no worse in
// both and better in one. The same for the same seed on any machine. Candidates without errors or ratios are
// never on the front and beat nothing. Throws std::invalid_argument for fewer than 1 draw, different numbers
// of frames and values that are not finite.
std::vector<FrontPlace> pareto_front(std::span<const FrontCandidate> candidates, int draws = 1000,
                                     std::uint64_t seed = 1);

}  // namespace herr
