// One job of a frame's probe update: 16 neighbouring probes and all their rays. Traced first, all jobs
// against last frame's light; then blended into what was gathered; published when all jobs are done.
#pragma once

#include <cstddef>

#include "renderer/probes/probe_volume.h"
#include "renderer/tiles/tile_job.h"

namespace herr {

// Of each ray: three channels of the light it brings, and 1 where it met nothing, otherwise 0.
inline constexpr std::size_t kProbeRayLanes = 4;

// One of those of one direction, of all probes of a job.
struct alignas(64) ProbeLanes {
  float of_probe[kProbeLanes];
};

struct ProbeJob {
  TileJob tile;  // scratch, counters, cycles, recorder; shading of this set: one light sample, no catchers
  ProbeVolume* volume = nullptr;
  int set = 0;
  int job = 0;
  ProbeLanes* radiance = nullptr;  // of this worker: kProbeRayLanes a ray
};

using ProbeKernel = void (*)(const ProbeJob&);
struct ProbeKernels {
  ProbeKernel trace;    // rays of the job's probes -> radiance; changes nothing else
  ProbeKernel blend;    // radiance -> gathered light, statistics, darkness
  ProbeKernel publish;  // gathered light -> what look-ups read
};
ProbeKernels probe_kernels_for(Isa isa);

}  // namespace herr
