#include "renderer/probes/probe_motion.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/common.hpp>

#include "renderer/memory_use.h"
#include "renderer/probes/byte_state.h"

namespace herr {
namespace {

// Of the spacing: a probe is asked about points up to one spacing away along each axis; half of one more,
// since its map is interpolated between directions.
constexpr double kReach = 1.5;
constexpr double kLooksPerTau = 4;
constexpr double kSettledAfter = 2.25;  // times tau; with the quarter between two looks less than 3

std::uint64_t digest(const void* bytes, std::size_t size, std::uint64_t before) {
  // FNV-1a, by words of four bytes.
  for (std::size_t i = 0; i + 4 <= size; i += 4) {
    std::uint32_t word;
    std::memcpy(&word, static_cast<const char*>(bytes) + i, 4);
    before = (before ^ word) * 0x100000001b3u;
  }
  return before;
}

std::uint64_t digest_of(const DeformationPose& pose) {
  const std::uint64_t start = 0xcbf29ce484222325u;
  const std::uint64_t joints = digest(pose.joints.data(), pose.joints.size() * sizeof(pose.joints[0]), start);
  return digest(pose.weights.data(), pose.weights.size() * sizeof(float), joints);
}

// The words of one probe's map.
template <typename Words>
auto map_of(Words& distances, std::size_t probe) {
  constexpr auto kWords = static_cast<std::size_t>(DistanceNodes::kCount);
  return std::span(distances).subspan(probe * kWords, kWords);
}

Bounds joined(const Bounds& a, const Bounds& b) {
  return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
}

}  // namespace

ProbeMotion::ProbeMotion(const Scene& scene, const EmbreeScene& geometry, const InstanceBoxes& boxes,
                         const ProbeGrid& grid, int workers)
    : scene_(scene), grid_(grid) {
  const auto n = static_cast<std::size_t>(grid.size());
  changed_ns_.assign(n, kNeverUpdated), blended_ns_.assign(n, kNeverUpdated);
  touched_.resize(n), waits_.resize(n);
  restless_.reserve(n), looks_.reserve(n);
  surveyors_.resize(static_cast<std::size_t>(workers));
  maps_.assign(surveyors_.size(), std::vector<std::uint32_t>(DistanceNodes::kCount));
  start_anew(geometry, boxes);
}

void ProbeMotion::start_anew(const EmbreeScene& geometry, const InstanceBoxes& boxes) {
  shown_.clear();
  for (std::size_t slot = 0; slot < scene_.instances.size(); ++slot) shown_.push_back(shown_at(slot, boxes));
  poses_.assign(scene_.deformations.size(), 0);
  shapes_.clear();
  for (std::size_t i = 0; i < scene_.deformations.size(); ++i) shapes_.push_back(geometry.shape(i));
  changed_.clear();
  changed_.reserve(2 * (shown_.size() + shapes_.size()));
  std::fill(touched_.begin(), touched_.end(), std::uint8_t{0});
  std::fill(waits_.begin(), waits_.end(), std::uint8_t{0});
  restless_.clear(), looks_.clear();
  together_ = 0;
}

ProbeMotion::Shown ProbeMotion::shown_at(std::size_t slot, const InstanceBoxes& boxes) const {
  const Instance& instance = scene_.instances[slot];
  return {instance.world_from_object, instance.mesh,
          instance.material,          static_cast<std::uint32_t>(instance.kind),
          instance.present ? 1u : 0u, boxes.of(slot)};
}

void ProbeMotion::note_instance(std::size_t slot, const InstanceBoxes& boxes) {
  const Shown now = shown_at(slot, boxes);
  if (slot >= shown_.size()) shown_.resize(slot + 1);
  Shown& before = shown_[slot];
  const bool same = before.present == now.present &&
                    (now.present == 0 || (before.place == now.place && before.mesh == now.mesh &&
                                          before.kind == now.kind && before.material == now.material));
  if (!same && before.present != 0) changed_.push_back(before.box);
  if (!same && now.present != 0) changed_.push_back(now.box);
  before = now;
}

void ProbeMotion::note_bend(std::size_t deformation, const SceneState& state, const EmbreeScene& geometry) {
  const std::uint64_t pose = digest_of(state.poses[deformation]);
  if (pose == poses_[deformation]) return;
  poses_[deformation] = pose;
  const Bounds now = geometry.shape(deformation), swept = joined(shapes_[deformation], now);
  shapes_[deformation] = now;
  for (const Instance& instance : scene_.instances) {
    const bool bends = instance.present && instance.kind == ShapeKind::mesh &&
                       instance.mesh == scene_.deformations[deformation].mesh;
    if (bends) changed_.push_back(box_around(swept, instance.world_from_object));
  }
}

void ProbeMotion::note(std::span<const ChangedSlot> slots, const SceneState& state,
                       const EmbreeScene& geometry, const InstanceBoxes& boxes) {
  for (const ChangedSlot& changed : slots) note_instance(changed.slot, boxes);
  for (std::size_t i = 0; i < std::min(poses_.size(), state.poses.size()); ++i) note_bend(i, state, geometry);
}

// The outermost probes answer for all that lies beyond them.
void ProbeMotion::unsettle(const Bounds& box, std::int64_t since_ns, std::int64_t t_ns) {
  if (!(box.lower.x <= box.upper.x)) return;
  glm::ivec3 first, last;
  for (int axis = 0; axis < 3; ++axis) {
    const double most = grid_.counts[axis] - 1;
    const double lower = (box.lower[axis] - grid_.lower[axis]) / grid_.spacing[axis] - 0.5 - kReach;
    const double upper = (box.upper[axis] - grid_.lower[axis]) / grid_.spacing[axis] - 0.5 + kReach;
    first[axis] = static_cast<int>(std::clamp(std::ceil(lower), 0.0, most));
    last[axis] = static_cast<int>(std::clamp(std::floor(upper), 0.0, most));
  }
  for (int z = first.z; z <= last.z; ++z) {
    for (int y = first.y; y <= last.y; ++y) {
      for (int x = first.x; x <= last.x; ++x) {
        const int probe = grid_.index({x, y, z});
        const auto i = static_cast<std::size_t>(probe);
        if (waits_[i] == 0) {
          waits_[i] = 1;
          blended_ns_[i] = since_ns;
          restless_.push_back(probe);
        }
        changed_ns_[i] = t_ns;
      }
    }
  }
}

void ProbeMotion::unsettle_all(std::int64_t t_ns) {
  restless_.clear();
  std::fill(waits_.begin(), waits_.end(), std::uint8_t{0});
  const Bounds all{grid_.lower, grid_.lower + glm::dvec3(grid_.counts) * grid_.spacing};
  unsettle(all, t_ns, t_ns);
}

// Those whose maps are the oldest, as many as have their turn in dt of the most that waited together. tau =
// 0, or dt < 0 for time that begins: all, and all is new.
void ProbeMotion::choose(std::int64_t t_ns, double dt_s, double tau_s, int most) {
  const bool at_once = tau_s <= 0 || dt_s < 0;
  const auto waiting = static_cast<std::int32_t>(restless_.size());
  together_ = std::max(together_, waiting);
  const double turn = at_once ? waiting : std::ceil(std::min(1.0, kLooksPerTau * dt_s / tau_s) * together_);
  const std::ptrdiff_t count = at_once ? waiting : std::min({static_cast<int>(turn), most, waiting});
  const auto older = [this](std::int32_t a, std::int32_t b) {
    const std::int64_t x = blended_ns_[static_cast<std::size_t>(a)],
                       y = blended_ns_[static_cast<std::size_t>(b)];
    return x != y ? x < y : a < b;
  };
  std::partial_sort(restless_.begin(), restless_.begin() + count, restless_.end(), older);
  const auto seconds_to = [&](std::int64_t from) { return static_cast<double>(t_ns - from) * 1e-9; };
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const std::int32_t probe = restless_[static_cast<std::size_t>(k)];
    const auto i = static_cast<std::size_t>(probe);
    const bool whole = at_once || seconds_to(changed_ns_[i]) >= kSettledAfter * tau_s;
    looks_.push_back(
        {probe, whole ? 0.0f : static_cast<float>(std::exp(-seconds_to(blended_ns_[i]) / tau_s))});
  }
}

void ProbeMotion::look(ProbeVolume& volume, const EmbreeScene& geometry, RenderThreads& threads) {
  const double nearest_m = double{volume.view(0, geometry.anchor()).nearest};
  for (ProbeSurveyor& surveyor : surveyors_) surveyor.face(geometry, grid_);
  const auto look_around = [&](int index, int worker) {
    const auto w = static_cast<std::size_t>(worker);
    Look& look = looks_[static_cast<std::size_t>(index)];
    const ProbeStanding standing = surveyors_[w].standing(grid_, look.probe);
    look.moved = standing.moved;
    for (ProbeSet& set : volume.sets) {
      look.elsewhere = set.put(look.probe, standing.place);
      std::uint32_t* words = map_of(set.distances, static_cast<std::size_t>(look.probe)).data();
      surveyors_[w].map(standing.place, set.mask, nearest_m, maps_[w].data());
      // From another place nothing looks as it did.
      blend_distances(maps_[w].data(), look.elsewhere ? 0.0 : double{look.kept}, words);
    }
  };
  threads.run(looked(), std::cref(look_around));  // by reference: the capture would not fit
}

void ProbeMotion::settle_down(ProbeVolume& volume, std::int64_t t_ns) {
  for (const Look& look : looks_) {
    const auto i = static_cast<std::size_t>(look.probe);
    volume.relocated_[i] = look.moved;
    touched_[i] = 1;
    blended_ns_[i] = t_ns;
    if (look.kept == 0) waits_[i] = 0;
  }
  std::erase_if(restless_,
                [this](std::int32_t probe) { return waits_[static_cast<std::size_t>(probe)] == 0; });
  if (restless_.empty()) together_ = 0;
}

void ProbeMotion::follow(ProbeVolume& volume, const EmbreeScene& geometry, RenderThreads& threads,
                         std::int64_t t_ns, int most) {
  looks_.clear();
  const std::int64_t last_ns = volume.last_ns();
  if (t_ns == last_ns) return;
  const bool begins = last_ns == kNeverUpdated, back = !begins && t_ns < last_ns;
  if (back) unsettle_all(t_ns);
  if (!changed_.empty() && !begins && !back) volume.stir();
  for (const Bounds& box : changed_) unsettle(box, begins || back ? t_ns : last_ns, t_ns);
  changed_.clear();
  if (restless_.empty()) return;
  const double dt_s = begins || back ? -1.0 : static_cast<double>(t_ns - last_ns) * 1e-9;
  choose(t_ns, dt_s, volume.settings.hysteresis_tau_s, most);
  look(volume, geometry, threads);
  settle_down(volume, t_ns);
}

void ProbeMotion::save(const ProbeVolume& volume, std::vector<std::byte>& bytes) const {
  const std::size_t start = bytes.size();
  ByteSink out(bytes);
  out.value(static_cast<std::uint32_t>(shown_.size()));
  for (const Shown& one : shown_) {
    out.value(one.place), out.value(one.mesh), out.value(one.material), out.value(one.kind);
    out.value(one.present), out.value(one.box);
  }
  out.array(poses_), out.array(shapes_), out.array(changed_ns_), out.array(blended_ns_), out.array(touched_);
  out.value(together_), out.value(static_cast<std::uint32_t>(restless_.size())), out.array(restless_);
  for (std::size_t i = 0; i < touched_.size(); ++i) {
    if (touched_[i] == 0) continue;
    out.value(static_cast<std::uint8_t>(volume.relocated_[i] ? 1 : 0));
    for (const ProbeSet& set : volume.sets) out.items(map_of(set.distances, i));
  }
  out.value(static_cast<std::uint64_t>(bytes.size() - start));
}

void ProbeMotion::restore(ProbeVolume& volume, std::span<const std::byte>& bytes) {
  std::uint64_t size = 0;
  if (bytes.size() >= sizeof size) std::memcpy(&size, bytes.data() + bytes.size() - sizeof size, sizeof size);
  if (size == 0 || size > bytes.size() - sizeof size)
    throw std::invalid_argument("probe state does not say what has moved");
  const std::size_t before = bytes.size() - sizeof size - static_cast<std::size_t>(size);
  ByteSource in(bytes.subspan(before, static_cast<std::size_t>(size)));
  bytes = bytes.first(before);
  std::uint32_t slots = 0, waiting = 0;
  in.value(slots);
  if (slots > size / sizeof(glm::dmat4x3)) throw std::invalid_argument("probe state is damaged");
  shown_.resize(slots);
  for (Shown& one : shown_) {
    in.value(one.place), in.value(one.mesh), in.value(one.material), in.value(one.kind);
    in.value(one.present), in.value(one.box);
  }
  in.array(poses_), in.array(shapes_), in.array(changed_ns_), in.array(blended_ns_), in.array(touched_);
  in.value(together_), in.value(waiting);
  if (waiting > touched_.size()) throw std::invalid_argument("probe state is damaged");
  restless_.resize(waiting);
  in.array(restless_);
  std::fill(waits_.begin(), waits_.end(), std::uint8_t{0});
  for (const std::int32_t probe : restless_) {
    if (probe < 0 || probe >= grid_.size()) throw std::invalid_argument("probe state is damaged");
    waits_[static_cast<std::size_t>(probe)] = 1;
  }
  for (std::size_t i = 0; i < touched_.size(); ++i) {
    if (touched_[i] == 0) continue;
    std::uint8_t relocated = 0;
    in.value(relocated);
    volume.relocated_[i] = relocated != 0;
    for (ProbeSet& set : volume.sets) in.items(map_of(set.distances, i));
  }
  if (!in.at_end()) throw std::invalid_argument("probe state is longer than expected");
}

std::int64_t ProbeMotion::bytes() const {
  std::int64_t sum = bytes_of(shown_) + bytes_of(poses_) + bytes_of(shapes_) + bytes_of(changed_) +
                     bytes_of(changed_ns_) + bytes_of(blended_ns_) + bytes_of(touched_) + bytes_of(waits_) +
                     bytes_of(restless_) + bytes_of(looks_);
  for (const auto& map : maps_) sum += bytes_of(map);
  return sum;
}

}  // namespace herr
