// Five faults that builds of tests/numerics have on purpose, one each: a relation of `herr study --stability`
// must find it, by name. Any other build has none of them, and nothing of them: the choice is made by the
// compiler. Before: the definition HERR_BROKEN_ON_PURPOSE. After: the five places that ask.
#pragma once

#include <cstdint>

namespace herr {

enum class Fault : std::uint8_t {
  none,
  singular_falloff,         // lights grow without end towards their middle, however large they are
  dropped_anchor,           // places are rounded to float before the anchor is taken off
  biased_adaptive_samples,  // adaptive light samples come from one end of the light
  euler_hysteresis,         // probes forget by Euler's rule, 1 - dt / tau
  samples_keyed_by_thread,  // random numbers depend on which thread traces a tile
};

// Not inline: it differs between the files of one program.
#ifdef HERR_BROKEN_ON_PURPOSE
constexpr Fault kFault = Fault::HERR_BROKEN_ON_PURPOSE;
#else
constexpr Fault kFault = Fault::none;
#endif

}  // namespace herr
