// Which samples of a tile lie at edges: a neighbour, in the same row or column, shows another surface, or the
// same one where another light is blocked, and both look different. Neighbours of other tiles are looked up
// by a ray each, and nobody knows how they look. Before: the tile is lit. After: smooth_edges.
#pragma once

#include "renderer/tracing/edge_rays-inl.h"
#include "renderer/tracing/resolve-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// Samples look different where a channel of their light differs by more than this share of both channels' sum
// and of a dark level, of white; or where the feed that they keep does.
constexpr float kLeastContrast = 1.0f / 24, kDarkLevel = 1.0f / 16, kLeastRatioStep = 1.0f / 32;

HWY_INLINE MF look_different(const EdgeSamples& samples, int a, int b, float white) {
  const auto at_a = static_cast<std::size_t>(a), at_b = static_cast<std::size_t>(b);
  const VF dark = set(kDarkLevel * white), share = set(kLeastContrast);
  const auto differs = [&](const EdgeSamples::Picture<float>& p) HWY_ATTR {
    const VF x = loadu(&p[at_a]), y = loadu(&p[at_b]);
    return hn::Gt(hn::Abs(hn::Sub(x, y)), hn::Mul(share, hn::Add(dark, hn::Add(x, y))));
  };
  const VF ratio_step = hn::Sub(loadu(&samples.ratio.y[at_a]), loadu(&samples.ratio.y[at_b]));
  const MF light =
      hn::Or(differs(samples.light.x), hn::Or(differs(samples.light.y), differs(samples.light.z)));
  return hn::Or(light, hn::Gt(hn::Abs(ratio_step), set(kLeastRatioStep)));
}

HWY_INLINE void mark(EdgeSamples& samples, int first, VI marks) {
  std::int32_t* to = &samples.marks[static_cast<std::size_t>(first)];
  hn::StoreU(hn::Or(hn::LoadU(kI, to), marks), kI, to);
}

// Marks samples [a, a + kLanes) and their neighbours [b, b + kLanes) that show different things.
HWY_INLINE void mark_edges(EdgeSamples& samples, const SeenSurface& at_a, int a, int b, float white) {
  const SeenSurface at_b = seen_from(samples, b);
  const VI none = hn::Set(kI, EdgeSamples::kNone);
  const MF known = hn::RebindMask(kF, hn::And(hn::Ne(at_a.surface, none), hn::Ne(at_b.surface, none)));
  const VI blocked_a = hn::LoadU(kI, &samples.blocked[static_cast<std::size_t>(a)]),
           blocked_b = hn::LoadU(kI, &samples.blocked[static_cast<std::size_t>(b)]);
  const MF one = on_one_surface(at_a, at_b);
  const MF shadow = hn::And(one, hn::RebindMask(kF, hn::Ne(blocked_a, blocked_b)));
  MF edges = hn::And(known, hn::Or(hn::Not(one), shadow));
  if (hn::AllFalse(kF, edges)) return;
  edges = hn::And(edges, look_different(samples, a, b, white));
  if (hn::AllFalse(kF, edges)) return;
  const VI marks = hn::IfThenElse(hn::RebindMask(kI, shadow), hn::Set(kI, EdgeSamples::kShadowEdge),
                                  hn::Set(kI, EdgeSamples::kSurfaceEdge));
  const VI found = hn::IfThenElseZero(hn::RebindMask(kI, edges), marks);
  mark(samples, a, found);
  mark(samples, b, found);
}

// Marks samples (column, row) of the tile whose neighbours in another tile, (columns, rows) away, show
// another surface.
template <SurfaceDetail kDetail>
HWY_NOINLINE void look_outside(const TileJob& job, VI column, VI row, int columns, int rows, MF lanes) {
  EdgeSamples& samples = *job.scratch->edges;
  const RayGrid& grid = *job.grid;
  const VI cells = cells_at(column, row);
  const SeenSurface own = seen_at(samples, cells);
  lanes = hn::And(lanes, hn::RebindMask(kF, hn::Ne(own.surface, hn::Set(kI, EdgeSamples::kNone))));
  if (hn::AllFalse(kF, lanes)) return;
  const VI height = hn::Set(kI, grid.sink.height), zero = hn::Zero(kI);
  const VI x = hn::Add(column, hn::Set(kI, job.x0 + columns));
  VI y = hn::Add(row, hn::Set(kI, job.y0 + rows));
  y = hn::IfThenElse(hn::Lt(y, zero), hn::Sub(height, hn::Set(kI, 1)),
                     hn::IfThenElse(hn::Eq(y, height), zero, y));
  const V3 direction = sample_directions(grid, x, y);
  lanes = hn::And(lanes, traceable(set3(grid.origin), direction));
  const SeenSurface met =
      trace_to_surface<kDetail>(job, direction, key_of(grid, x, y), spread_at(grid, x), lanes);
  const MF other = hn::AndNot(on_one_surface(own, met), lanes);
  if (hn::AllFalse(kF, other)) return;
  alignas(64) std::int32_t marks[kMaxLanes], at[kMaxLanes];
  hn::Store(hn::IfThenElseZero(hn::RebindMask(kI, other), hn::Set(kI, EdgeSamples::kSurfaceEdge)), kI, marks);
  hn::Store(cells, kI, at);
  for (int i = 0; i < kLanes; ++i) samples.marks[static_cast<std::size_t>(at[i])] |= marks[i];
}

// The four sides of the tile. Beyond the innermost and the outermost column there is nothing to see.
template <SurfaceDetail kDetail>
HWY_INLINE void look_around(const TileJob& job, int columns, int rows) {
  const auto lanes_of = [](int start, int length) HWY_ATTR { return first_lanes(length - start); };
  for (int start = 0; start < columns; start += kLanes) {
    const VI column = hn::Add(hn::Iota(kI, 0), hn::Set(kI, start));
    look_outside<kDetail>(job, column, hn::Zero(kI), 0, -1, lanes_of(start, columns));
    look_outside<kDetail>(job, column, hn::Set(kI, rows - 1), 0, 1, lanes_of(start, columns));
  }
  for (int start = 0; start < rows; start += kLanes) {
    const VI row = hn::Add(hn::Iota(kI, 0), hn::Set(kI, start));
    const MF lanes = lanes_of(start, rows);
    if (job.x0 > 0) look_outside<kDetail>(job, hn::Zero(kI), row, -1, 0, lanes);
    if (job.x0 + columns >= job.grid->sink.width) continue;
    look_outside<kDetail>(job, hn::Set(kI, columns - 1), row, 1, 0, lanes);
  }
}

// Lists the tile's samples that are marked, block by block: rays of neighbours stay together.
HWY_NOINLINE inline void list_marked(EdgeSamples& samples, int x0, int y0) {
  for (int p = 0; p < samples.packets; ++p) {
    const int column = samples.packet_x[static_cast<std::size_t>(p)] - x0,
              row = samples.packet_y[static_cast<std::size_t>(p)] - y0;
    alignas(64) std::int32_t marks[kMaxLanes];
    from_picture(samples.marks, column, row, marks);
    const auto marked = hn::Ne(hn::Load(kI, marks), hn::Zero(kI));
    if (hn::AllFalse(kI, marked)) continue;
    const auto at = static_cast<std::size_t>(samples.count);
    hn::StoreU(hn::Compress(hn::Add(lane_column(), hn::Set(kI, column)), marked), kI, &samples.column[at]);
    hn::StoreU(hn::Compress(hn::Add(lane_row(), hn::Set(kI, row)), marked), kI, &samples.row[at]);
    samples.count += static_cast<int>(hn::CountTrue(kI, marked));
  }
}

template <SurfaceDetail kDetail>
HWY_NOINLINE void find_edges(const TileJob& job) {
  EdgeSamples& samples = *job.scratch->edges;
  const int columns = std::min(kTileSide, job.grid->sink.width - job.x0);
  const int rows = std::min(kTileSide, job.grid->sink.height - job.y0);
  const float white = job.shading->shown_white;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; column += kLanes) {
      const int at = EdgeSamples::at(column, row);
      const SeenSurface here = seen_from(samples, at);
      mark_edges(samples, here, at, at + 1, white);
      mark_edges(samples, here, at, at + EdgeSamples::kStride, white);
    }
  }
  look_around<kDetail>(job, columns, rows);
  list_marked(samples, job.x0, job.y0);
  job.counters->edge_samples += samples.count;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
