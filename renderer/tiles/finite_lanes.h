// No NaN and nothing infinite leaves a stage: debug builds ask after each one, release builds have none of
// it. Before: a stage has filled its lanes of a batch. After: the next one reads them.
#pragma once

#include <span>
#include <string>

#include "renderer/stage_times.h"
#include "renderer/tiles/tile_job.h"

namespace herr {

// The first number of hits [0, count) that is not finite, of the lanes that `stage` fills at surfaces:
// "direct.x of hit 12 is nan". Empty where all are finite.
std::string first_not_finite(const HitBatch& hits, int count, Stage stage, const FramePlan& plan);
// The same of numbers in a row, or of half floats by their bits: "mean, number 3 is inf".
std::string first_not_finite(std::span<const float> numbers, const std::string& what);
std::string first_not_finite(std::span<const std::uint16_t> halfs, const std::string& what);

#ifdef NDEBUG
inline constexpr bool kStagesAreChecked = false;
#else
inline constexpr bool kStagesAreChecked = true;
#endif

// Throws std::logic_error, with the stage's name before it, where `found` says something.
void require_none(Stage stage, const std::string& found);

inline void require_finite(const HitBatch& hits, int count, Stage stage, const FramePlan& plan) {
  if constexpr (kStagesAreChecked) require_none(stage, first_not_finite(hits, count, stage, plan));
}

}  // namespace herr
