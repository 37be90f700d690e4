#include "renderer/bench/bare_pixels.h"

#include "renderer/simd/kernel_for.h"

namespace herr {

HERR_DECLARE_KERNEL(PrecomputePixels, precompute_pixels);
HERR_DECLARE_KERNEL(CompositePrecomputed, composite_precomputed);

PrecomputePixels precompute_pixels_for(Isa isa) {
  return HERR_KERNEL_FOR(isa, precompute_pixels);
}
CompositePrecomputed composite_precomputed_for(Isa isa) {
  return HERR_KERNEL_FOR(isa, composite_precomputed);
}

}  // namespace herr
