// The probes of a scene: where they stand, what they have gathered, and which of them a frame updates.
// Dynamic diffuse global illumination after Majercik et al., "Dynamic Diffuse Global Illumination with
// Ray-Traced Irradiance Fields" (JCGT 2019). What is gathered is kept in float as radiance^(1/gamma), apart
// from the packed copy that look-ups read: so a frame reads only what the last frame left.
// Before: probe_grid, probe_placement. After: probe_trace.cpp updates, probe_lookup-inl.h reads.
// Not thread-safe but for what the kernels do to different probes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "renderer/probe_counts.h"
#include "renderer/probes/probe_grid.h"
#include "renderer/probes/probe_rays.h"
#include "renderer/probes/probe_view.h"
#include "renderer/render_settings.h"
#include "sessions/format/pose.h"

namespace herr {

inline constexpr int kProbeLanes = 16;    // probes of one job
inline constexpr int kLightChannel = 80;  // floats from one channel to the next: directions, padded
inline constexpr int kLightFloats = 3 * kLightChannel;  // of one probe
inline constexpr std::int64_t kNeverUpdated = std::numeric_limits<std::int64_t>::min();
inline constexpr float kDarkShare = 1e-9f;  // of the white that is shown: a 500,000th of an 8-bit step
inline constexpr int kUpdatesToSleep = 16;  // dark ones in a row: light needs as many bounces to come in

// One world that probes look at: everything, or the catchers alone (DESIGN: differential rendering).
struct ProbeSet {
  unsigned mask = ~0u;                   // of the geometry that is there
  std::vector<std::uint32_t> distances;  // as ProbeView, made at the start and where something moves
  std::vector<float> places;             // as ProbeView
  std::vector<std::uint32_t> light;      // as ProbeView, as of the last frame
  std::vector<float> gathered;           // kLightFloats per probe: radiance^(1/gamma), channel by channel
  std::vector<float> mean, square;       // per probe: luminance of its rays and its square, blended likewise
  std::vector<std::uint8_t> dark_updates;  // per probe, in a row, up to kUpdatesToSleep

  // Where a probe stands, metres from the grid's lower corner. True: it stood elsewhere.
  bool put(int probe, const glm::dvec3& place);
};

// What a job of a frame found out, added up in the order of jobs.
struct ProbeJobResult {
  double change = 0;  // sum over its probes: how far this frame's light lies from what was gathered, [0, 1]
  std::int32_t reacting = 0;   // probes that met a large change
  std::int64_t nonfinite = 0;  // rays that brought NaN or Inf
};

class ProbeVolume {
 public:
  // `sets`: 1, or 2 with catchers alone. Allocates everything; probe_placement fills places and distances.
  ProbeVolume(const ProbeGrid& grid, const ProbeSettings& settings, int sets);

  // Chooses the probes of this frame, `most` of them and those of the budget at most, and the share that each
  // keeps of what it had. `power`: summed intensity of all lights; when it doubles, sleeping probes wake. At
  // the time of the last frame again, no probe is updated. No allocation.
  void begin_frame(std::int64_t t_ns, double power, int most);
  // As if there had been no frame.
  void start_anew();
  // Something moved: light may come to where none was. Sleeping probes wake, once in 64 frames.
  void stir();
  // Of the last frame; kNeverUpdated before the first.
  std::int64_t last_ns() const { return last_ns_; }
  // Sums up; `jobs` in order.
  void end_frame();

  std::span<const std::int32_t> selected() const { return selected_; }
  // Probes that the budget allows a frame to update, and rays of a frame that updates them all.
  int most_updated() const {
    return settings.budget > 0 ? std::min(settings.budget, grid.size()) : grid.size();
  }
  std::int64_t most_rays() const;
  int job_count() const { return static_cast<int>((selected_.size() + kProbeLanes - 1) / kProbeLanes); }
  std::span<const std::int32_t> job_probes(int job) const;
  std::span<const float> job_keeps(int job) const;
  bool is_near(int probe) const { return near_[static_cast<std::size_t>(probe)]; }
  ProbeView view(int set, const glm::dvec3& anchor) const;
  const ProbeCounts& counts() const { return counts_; }
  std::int64_t bytes() const;

  // State between frames as bytes: format version, grid, everything gathered. Exact.
  std::vector<std::byte> save() const;
  // Selects every probe that has gathered something, to be published. Throws std::invalid_argument when the
  // bytes are no state of a volume like this one.
  void restore(std::span<const std::byte> bytes);

  const ProbeGrid grid;
  const ProbeSettings settings;
  ProbeDirections directions;
  std::vector<glm::dvec3> node_directions;  // of the irradiance map
  std::vector<ProbeSet> sets;
  std::vector<ProbeJobResult> results;  // per job and set

 private:
  friend class ProbePlacement;
  friend class ProbeMotion;
  friend class ProbeReader;
  bool asleep(int probe) const;
  void wake();
  void forget();
  void select(std::int64_t t_ns, int most);

  std::vector<std::int32_t> order_;  // blocks of neighbours
  std::vector<bool> near_, relocated_;
  std::vector<std::int32_t> selected_;
  std::vector<float> keeps_;
  ProbeCounts counts_;
  std::vector<std::int64_t> updated_ns_;
  std::int64_t frame_ = 0, last_ns_ = kNeverUpdated, stirred_ = -1;  // stirred_: frame, -1 never
  std::int32_t cursor_ = 0;
  double power_ = 0;
};

}  // namespace herr
