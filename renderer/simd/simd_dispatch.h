// Picks the instance of a Google Highway kernel that was compiled for one instruction set.
// Highway's own choice is one for the whole process; a renderer keeps the pointers that it resolved, so
// renderers of different instruction sets can live side by side.
#pragma once

#include <hwy/highway.h>

#include <mutex>

#include "renderer/render_settings.h"

namespace herr {

inline std::int64_t highway_target(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return HWY_AVX3;
    case Isa::avx2:
      return HWY_AVX2;
    default:
      return HWY_SSE4;
  }
}

// Calls `pointer()` - a lambda around &HWY_DYNAMIC_DISPATCH(kernel) - while `isa` is Highway's chosen target.
// Thread-safe. `isa` must be resolved.
template <typename PointerOf>
auto kernel_for(Isa isa, PointerOf&& pointer) {
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  hwy::GetChosenTarget().Update(highway_target(isa));
  const auto chosen = pointer();
  hwy::GetChosenTarget().DeInit();
  return chosen;
}

}  // namespace herr
