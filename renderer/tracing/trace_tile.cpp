#include "renderer/simd/kernel_for.h"
#include "renderer/tiles/tile_job.h"

namespace herr {

HERR_DECLARE_KERNEL(TraceTile, trace_tile);

TraceTile trace_tile_for(Isa isa) {
  return HERR_KERNEL_FOR(isa, trace_tile);
}

}  // namespace herr
