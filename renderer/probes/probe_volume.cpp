#include "renderer/probes/probe_volume.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "renderer/broken_on_purpose.h"
#include "renderer/memory_use.h"
#include "renderer/probes/byte_state.h"

namespace herr {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;
constexpr std::int64_t kLookAgain = 64;   // frames between two looks of a sleeping probe
constexpr double kMorePower = 2;          // lights that grow by more than this factor wake sleeping probes
constexpr double kNearestShare = 0.1;     // of the smallest spacing: nearer geometry is taken to be there
constexpr double kToleranceShare = 0.01;  // of the smallest spacing
constexpr std::uint32_t kStateVersion = 3;
constexpr char kStateMark[8] = {'H', 'E', 'R', 'R', 'P', 'R', 'O', 'B'};

// exp(-dt / tau), the exact solution of exponential forgetting for any dt; 0 for a probe's first time.
float kept_share(std::int64_t updated_ns, std::int64_t t_ns, double tau_s) {
  if (updated_ns == kNeverUpdated || tau_s <= 0) return 0.0f;
  const double age_s = static_cast<double>(t_ns - updated_ns) * kSecondsPerNanosecond;
  if constexpr (kFault == Fault::euler_hysteresis) {
    return static_cast<float>(std::max(1 - age_s / tau_s, 0.0));
  }
  return static_cast<float>(std::exp(-age_s / tau_s));
}

}  // namespace

ProbeVolume::ProbeVolume(const ProbeGrid& grid_in, const ProbeSettings& settings_in, int set_count)
    : grid(grid_in),
      settings(settings_in),
      sets(static_cast<std::size_t>(set_count)),
      order_(neighbour_order(grid)) {
  const auto n = static_cast<std::size_t>(grid.size());
  for (int node = 0; node < LightNodes::kCount; ++node) {
    if (LightNodes::first_of(node) == node) node_directions.push_back(LightNodes::direction(node));
  }
  directions.allocate(settings.rays, static_cast<int>(node_directions.size()));
  directions.sky_nodes.resize(std::size_t{4} * LightNodes::kCount);
  for (ProbeSet& set : sets) {
    set.distances.resize(n * DistanceNodes::kCount);
    set.places.resize(n * 4);
    set.light.resize(n * LightNodes::kCount * kLightWords);
    set.gathered.resize(n * kLightFloats);
    set.mean.resize(n), set.square.resize(n);
    set.dark_updates.resize(n);
  }
  near_.resize(n), relocated_.resize(n);
  updated_ns_.assign(n, kNeverUpdated);
  selected_.reserve(n), keeps_.reserve(n);
  results.resize(sets.size() * ((n + kProbeLanes - 1) / kProbeLanes));
}

bool ProbeSet::put(int probe, const glm::dvec3& place) {
  float* to = &places[4 * static_cast<std::size_t>(probe)];
  bool elsewhere = false;
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<float>(place[axis]);
    elsewhere |= to[axis] != at;
    to[axis] = at;
  }
  return elsewhere;
}

bool ProbeVolume::asleep(int probe) const {
  const auto i = static_cast<std::size_t>(probe);
  return std::all_of(sets.begin(), sets.end(),
                     [i](const ProbeSet& set) { return set.dark_updates[i] >= kUpdatesToSleep; });
}

void ProbeVolume::wake() {
  for (ProbeSet& set : sets) std::fill(set.dark_updates.begin(), set.dark_updates.end(), std::uint8_t{0});
}

void ProbeVolume::forget() {
  wake();
  std::fill(updated_ns_.begin(), updated_ns_.end(), kNeverUpdated);
  for (ProbeSet& set : sets) {
    for (std::size_t i = 3; i < set.places.size(); i += 4) set.places[i] = 0.0f;
  }
  frame_ = 0;
  stirred_ = -1;
  cursor_ = 0;
  power_ = 0;
}

void ProbeVolume::stir() {
  if (stirred_ >= 0 && frame_ - stirred_ < kLookAgain) return;
  stirred_ = frame_;
  wake();
}

void ProbeVolume::start_anew() {
  forget();
  last_ns_ = kNeverUpdated;
}

void ProbeVolume::begin_frame(std::int64_t t_ns, double power, int most) {
  selected_.clear();
  keeps_.clear();
  if (t_ns == last_ns_) return;
  // Time that runs backwards is another run: nothing of it has been gathered.
  if (last_ns_ != kNeverUpdated && t_ns < last_ns_) forget();
  if (power > kMorePower * power_) wake();
  last_ns_ = t_ns;
  power_ = power;
  select(t_ns, std::min(most, most_updated()));
  ++frame_;
}

void ProbeVolume::select(std::int64_t t_ns, int most) {
  counts_ = {};
  const auto n = static_cast<std::int32_t>(order_.size());
  std::int32_t next = cursor_;
  for (std::int32_t step = 0; step < n; ++step) {
    const std::int32_t position = (cursor_ + step) % n;
    const std::int32_t probe = order_[static_cast<std::size_t>(position)];
    const auto i = static_cast<std::size_t>(probe);
    if (relocated_[i]) ++counts_.relocated;
    const bool awake = near_[i] && !asleep(probe);
    ++(awake ? counts_.active : counts_.inactive);
    const bool looks = awake || (near_[i] && (frame_ + probe) % kLookAgain == 0);
    if (!looks || static_cast<std::int32_t>(selected_.size()) == most) continue;
    selected_.push_back(probe);
    keeps_.push_back(kept_share(updated_ns_[i], t_ns, settings.hysteresis_tau_s));
    updated_ns_[i] = t_ns;
    next = position + 1;
  }
  cursor_ = most < n ? next % std::max(n, 1) : 0;  // all of them: no order to go on with
}

void ProbeVolume::end_frame() {
  counts_.updated = static_cast<std::int64_t>(selected_.size());
  counts_.reacting = 0;
  double change = 0;
  for (int job = 0; job < job_count(); ++job) {
    const ProbeJobResult& result = results[static_cast<std::size_t>(job) * sets.size()];
    change += result.change;
    counts_.reacting += result.reacting;
  }
  counts_.variability = counts_.updated > 0 ? change / static_cast<double>(counts_.updated) : 0.0;
}

std::int64_t ProbeVolume::most_rays() const {
  return std::int64_t{most_updated()} * settings.rays;
}

std::span<const std::int32_t> ProbeVolume::job_probes(int job) const {
  const auto first = static_cast<std::size_t>(job) * kProbeLanes;
  return selected().subspan(first, std::min<std::size_t>(kProbeLanes, selected_.size() - first));
}

std::span<const float> ProbeVolume::job_keeps(int job) const {
  const auto first = static_cast<std::size_t>(job) * kProbeLanes;
  return std::span(keeps_).subspan(first, std::min<std::size_t>(kProbeLanes, keeps_.size() - first));
}

ProbeView ProbeVolume::view(int set, const glm::dvec3& anchor) const {
  const ProbeSet& from = sets[static_cast<std::size_t>(set)];
  ProbeView view;
  const double smallest = grid.smallest_spacing();
  for (int axis = 0; axis < 3; ++axis) {
    view.lower[axis] = static_cast<float>(grid.lower[axis] - anchor[axis]);
    view.inverse_spacing[axis] = static_cast<float>(1 / grid.spacing[axis]);
    view.counts[axis] = grid.counts[axis];
  }
  view.nearest = static_cast<float>(kNearestShare * smallest);
  view.normal_bias_m = static_cast<float>(settings.normal_bias * smallest);
  view.view_bias_m = static_cast<float>(settings.view_bias * smallest);
  view.tolerance_m = static_cast<float>(kToleranceShare * smallest);
  view.places = from.places.data();
  view.distances = from.distances.data();
  view.light = from.light.data();
  view.sky = directions.sky.empty() ? nullptr : directions.sky_nodes.data();
  return view;
}

std::vector<std::byte> ProbeVolume::save() const {
  std::vector<std::byte> bytes;
  ByteSink out(bytes);
  out.value(kStateMark), out.value(kStateVersion), out.value(static_cast<std::uint32_t>(sets.size()));
  out.value(grid.counts), out.value(grid.lower), out.value(grid.spacing);
  out.value(frame_), out.value(last_ns_), out.value(stirred_), out.value(cursor_), out.value(power_);
  out.array(updated_ns_);
  for (const ProbeSet& set : sets) {
    out.array(set.places), out.array(set.gathered);
    out.array(set.mean), out.array(set.square), out.array(set.dark_updates);
  }
  return bytes;
}

void ProbeVolume::restore(std::span<const std::byte> bytes) {
  ByteSource in(bytes);
  char mark[8];
  std::uint32_t version = 0, set_count = 0;
  glm::ivec3 counts{0};
  glm::dvec3 lower{0.0}, spacing{0.0};
  in.value(mark), in.value(version), in.value(set_count);
  in.value(counts), in.value(lower), in.value(spacing);
  const bool same = std::memcmp(mark, kStateMark, sizeof mark) == 0 && version == kStateVersion &&
                    set_count == sets.size() && counts == grid.counts && lower == grid.lower &&
                    spacing == grid.spacing;
  if (!same) throw std::invalid_argument("probe state belongs to another version, scene or grid");
  in.value(frame_), in.value(last_ns_), in.value(stirred_), in.value(cursor_), in.value(power_);
  in.array(updated_ns_);
  for (ProbeSet& set : sets) {
    in.array(set.places), in.array(set.gathered);
    in.array(set.mean), in.array(set.square), in.array(set.dark_updates);
  }
  if (!in.at_end()) throw std::invalid_argument("probe state is longer than expected");
  if (cursor_ < 0 || cursor_ >= std::max(grid.size(), 1))
    throw std::invalid_argument("probe state is damaged");
  selected_.clear();
  keeps_.clear();
  for (const std::int32_t probe : order_) {
    if (updated_ns_[static_cast<std::size_t>(probe)] == kNeverUpdated) continue;
    selected_.push_back(probe);
    keeps_.push_back(1.0f);
  }
}

std::int64_t ProbeVolume::bytes() const {
  std::int64_t sum = bytes_of(node_directions) + bytes_of(results) + bytes_of(order_) + bytes_of(selected_) +
                     bytes_of(keeps_) + bytes_of(updated_ns_);
  sum += 3 * bytes_of(directions.x) + bytes_of(directions.weights) + bytes_of(directions.first_weight);
  sum += bytes_of(directions.sky) + bytes_of(directions.sky_nodes);
  sum += static_cast<std::int64_t>(near_.capacity() + relocated_.capacity()) / 8;
  for (const ProbeSet& set : sets) {
    sum += bytes_of(set.distances) + bytes_of(set.places) + bytes_of(set.light) + bytes_of(set.gathered) +
           bytes_of(set.mean) + bytes_of(set.square) + bytes_of(set.dark_updates);
  }
  return sum;
}

}  // namespace herr
