#include "renderer/simd/kernel_for.h"
#include "renderer/viewports/viewport_job.h"

namespace herr {

HERR_DECLARE_KERNEL(CompositeStrip, composite_strip);

CompositeStrip composite_strip_for(Isa isa) {
  return HERR_KERNEL_FOR(isa, composite_strip);
}

}  // namespace herr
