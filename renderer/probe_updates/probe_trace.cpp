#include "renderer/probe_updates/probe_job.h"
#include "renderer/simd/kernel_for.h"

namespace herr {

HERR_DECLARE_KERNEL(ProbeKernel, trace_probes);
HERR_DECLARE_KERNEL(ProbeKernel, blend_probes);
HERR_DECLARE_KERNEL(ProbeKernel, publish_probes);

ProbeKernels probe_kernels_for(Isa isa) {
  return {HERR_KERNEL_FOR(isa, trace_probes), HERR_KERNEL_FOR(isa, blend_probes),
          HERR_KERNEL_FOR(isa, publish_probes)};
}

}  // namespace herr
