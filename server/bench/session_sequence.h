// Frames of a session as `herr bench` measures them: a few, spread over it, in order, each as `herr replay`
// renders it. Before: bench_command opened the session. After: bench_frames, bench_run, measure_left_out.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/bench_frame.h"
#include "server/frames/frame_step.h"

namespace herr {

// Numbers of `count` frames of the range (of all, if it has fewer): the middles of as many equal parts.
std::vector<std::int64_t> spread_frames(const FrameRange& range, int count);

class SessionSequence final : public BenchSequence {
 public:
  // `step` must outlive it. Numbers ascend.
  SessionSequence(FrameStep& step, std::vector<std::int64_t> numbers)
      : step_(step), numbers_(std::move(numbers)) {}

  int frames() const override { return static_cast<int>(numbers_.size()); }
  void rewind() override { step_.rewind(); }
  void render(int index, RenderedFrame& out) override {
    step_.prepare(numbers_[static_cast<std::size_t>(index)]);
    step_.render(out);
  }
  // For who renders by other means: sample and state are the step's.
  const FrameStep& prepare(int index) {
    step_.prepare(numbers_[static_cast<std::size_t>(index)]);
    return step_;
  }

 private:
  FrameStep& step_;
  const std::vector<std::int64_t> numbers_;
};

}  // namespace herr
