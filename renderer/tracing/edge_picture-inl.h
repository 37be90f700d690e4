// A tile's samples between packets of blocks and rows of the tile (tiles/edge_samples.h), and which of them
// lie on one surface. Before: first hits, resolve. After: find_edges, edge_rays.
#pragma once

#include <algorithm>
#include <cstring>

#include "renderer/tiles/generate_rays-inl.h"
#include "renderer/tiles/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Tells the random numbers of further rays from those of samples.
constexpr std::uint32_t kEdgeSalt = 0x2545f491u;

// Lanes of a packet whose first sample is (column, row) of the tile -> its rows of a picture, and back.
template <typename T>
HWY_INLINE void to_picture(const T* lanes, EdgeSamples::Picture<T>& picture, int column, int row) {
  for (int r = 0; r < kBlockRows; ++r) {
    std::memcpy(&picture[static_cast<std::size_t>(EdgeSamples::at(column, row + r))], lanes + 4 * r,
                4 * sizeof(T));
  }
}
template <typename T>
HWY_INLINE void from_picture(const EdgeSamples::Picture<T>& picture, int column, int row, T* lanes) {
  for (int r = 0; r < kBlockRows; ++r) {
    std::memcpy(lanes + 4 * r, &picture[static_cast<std::size_t>(EdgeSamples::at(column, row + r))],
                4 * sizeof(T));
  }
}
HWY_INLINE void to_picture(VF value, EdgeSamples::Picture<float>& picture, int column, int row) {
  alignas(64) float lanes[kMaxLanes];
  hn::Store(value, kF, lanes);
  to_picture(lanes, picture, column, row);
}
HWY_INLINE void to_picture(VI value, EdgeSamples::Picture<std::int32_t>& picture, int column, int row) {
  alignas(64) std::int32_t lanes[kMaxLanes];
  hn::Store(value, kI, lanes);
  to_picture(lanes, picture, column, row);
}
HWY_INLINE void to_picture(const V3& value, EdgeSamples::Picture3& picture, int column, int row) {
  to_picture(value.x, picture.x, column, row);
  to_picture(value.y, picture.y, column, row);
  to_picture(value.z, picture.z, column, row);
}
HWY_INLINE V3 from_picture(const EdgeSamples::Picture3& picture, int column, int row) {
  alignas(64) float x[kMaxLanes], y[kMaxLanes], z[kMaxLanes];
  from_picture(picture.x, column, row, x);
  from_picture(picture.y, column, row, y);
  from_picture(picture.z, column, row, z);
  return load3(x, y, z);
}

HWY_INLINE VI gather(const EdgeSamples::Picture<std::int32_t>& picture, VI cells) {
  return hn::GatherIndex(kI, picture.data(), cells);
}
HWY_INLINE VF gather(const EdgeSamples::Picture<float>& picture, VI cells) {
  return hn::GatherIndex(kF, picture.data(), cells);
}
HWY_INLINE V3 gather(const EdgeSamples::Picture3& picture, VI cells) {
  return {gather(picture.x, cells), gather(picture.y, cells), gather(picture.z, cells)};
}

// What samples show: a surface (kMissed: none), where, its geometric normal on the viewer's side, and how far
// rounding may have put it off.
struct SeenSurface {
  VI surface;
  V3 position, normal;
  VF offset;
};

HWY_INLINE SeenSurface seen_from(const EdgeSamples& samples, int first) {
  const auto at = static_cast<std::size_t>(first);
  const auto row = [&](const EdgeSamples::Picture3& p) HWY_ATTR {
    return V3{loadu(&p.x[at]), loadu(&p.y[at]), loadu(&p.z[at])};
  };
  return {hn::LoadU(kI, &samples.surface[at]), row(samples.position), row(samples.normal),
          loadu(&samples.offset[at])};
}
HWY_INLINE SeenSurface seen_at(const EdgeSamples& samples, VI cells) {
  return {gather(samples.surface, cells), gather(samples.position, cells), gather(samples.normal, cells),
          gather(samples.offset, cells)};
}

// Neighbours of one instance lie on one surface where neither rises above the plane of the other by more than
// this share of the way between them, and their normals are turned by less than this cosine.
constexpr float kMostRise = 0.35f, kLeastTurnCosine = 0.9f;

// The same surface, or none: of what is known of both.
HWY_INLINE MF on_one_surface(const SeenSurface& a, const SeenSurface& b) {
  const MF same = hn::RebindMask(kF, hn::Eq(a.surface, b.surface));
  const MF missed = hn::RebindMask(kF, hn::Lt(a.surface, hn::Zero(kI)));
  const V3 way = sub(b.position, a.position);
  const VF rise = hn::Max(hn::Abs(dot(a.normal, way)), hn::Abs(dot(b.normal, way)));
  const VF most = hn::MulAdd(set(kMostRise), hn::Sqrt(dot(way, way)), hn::Max(a.offset, b.offset));
  const MF flat = hn::And(hn::Le(rise, most), hn::Ge(dot(a.normal, b.normal), set(kLeastTurnCosine)));
  return hn::And(same, hn::Or(missed, flat));
}

// A tile begins: nothing is known of any sample.
HWY_NOINLINE inline void begin_edges(const TileJob& job, int packets) {
  TileScratch& scratch = *job.scratch;
  EdgeSamples& samples = *scratch.edges;
  samples.surface.fill(EdgeSamples::kNone);
  samples.kind.fill(static_cast<std::int32_t>(HitKind::none));
  samples.marks.fill(0);
  std::fill_n(samples.blocked_at.begin(), packets * kLanes, 0);
  std::copy_n(scratch.packet_x.begin(), packets, samples.packet_x.begin());
  std::copy_n(scratch.packet_y.begin(), packets, samples.packet_y.begin());
  samples.packets = packets;
  samples.count = samples.anew_count = 0;
  samples.notes = true;
}

// Remembers what traced packet `p` shows of its first layer.
HWY_NOINLINE inline void note_surfaces(const TileJob& job, int p) {
  TileScratch& scratch = *job.scratch;
  EdgeSamples& samples = *scratch.edges;
  const HitBatch& hits = scratch.first;
  const int slot = p * kLanes;
  const int column = samples.packet_x[static_cast<std::size_t>(p)] - job.x0,
            row = samples.packet_y[static_cast<std::size_t>(p)] - job.y0;
  const VI kind = hn::Load(kI, &hits.kind[slot]);
  const VI instance = hn::BitCast(kI, hn::Load(kU, packets_of(scratch)[p].hit.instID[0]));
  const VI missed = hn::Set(kI, EdgeSamples::kMissed), none = hn::Set(kI, EdgeSamples::kNone);
  const VI surface = hn::IfThenElse(hn::Eq(kind, hn::Set(kI, static_cast<int>(HitKind::miss))), missed,
                                    hn::IfThenElse(hn::Eq(kind, hn::Zero(kI)), none, instance));
  to_picture(surface, samples.surface, column, row);
  to_picture(kind, samples.kind, column, row);
  to_picture(load3(hits.position, slot), samples.position, column, row);
  to_picture(load3(hits.geometric_normal, slot), samples.normal, column, row);
  to_picture(load(&hits.offset[slot]), samples.offset, column, row);
}

// The first layer is lit: remembers which lights are blocked, and what short rays found.
HWY_NOINLINE inline void note_light(const TileJob& job) {
  EdgeSamples& samples = *job.scratch->edges;
  const HitBatch& hits = job.scratch->first;
  for (int p = 0; p < samples.packets; ++p) {
    const int column = samples.packet_x[static_cast<std::size_t>(p)] - job.x0,
              row = samples.packet_y[static_cast<std::size_t>(p)] - job.y0;
    const auto slot = static_cast<std::size_t>(p * kLanes);
    to_picture(&samples.blocked_at[slot], samples.blocked, column, row);
    if (!job.shading->plan->occlusion) continue;
    to_picture(&hits.open[slot], samples.open, column, row);
    to_picture(&hits.open_without[slot], samples.open_without, column, row);
  }
  samples.notes = false;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
