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
struct Contrast {
  float share, dark, ratio_step;
};
constexpr Contrast kEdgeContrast{1.0f / 12, 1.0f / 16, 1.0f / 32};
// From which on all further rays pay; half as many do below.
constexpr Contrast kStrongContrast{3.0f / 5, 1.0f / 16, 1.0f / 8};
// From which on samples of one surface are taken to stand for no more than themselves.
constexpr Contrast kShadingContrast{1.0f / 4, 1.0f / 4, 1.0f / 4};

HWY_INLINE MF look_different(const EdgeSamples& samples, int a, int b, float white, const Contrast& least) {
  const auto at_a = static_cast<std::size_t>(a), at_b = static_cast<std::size_t>(b);
  const VF dark = set(least.dark * white), share = set(least.share);
  const auto differs = [&](const EdgeSamples::Picture<float>& p) HWY_ATTR {
    const VF x = loadu(&p[at_a]), y = loadu(&p[at_b]);
    return hn::Gt(hn::Abs(hn::Sub(x, y)), hn::Mul(share, hn::Add(dark, hn::Add(x, y))));
  };
  const VF ratio_step = hn::Sub(loadu(&samples.ratio.y[at_a]), loadu(&samples.ratio.y[at_b]));
  const MF light =
      hn::Or(differs(samples.light.x), hn::Or(differs(samples.light.y), differs(samples.light.z)));
  return hn::Or(light, hn::Gt(hn::Abs(ratio_step), set(least.ratio_step)));
}

HWY_INLINE void mark(EdgeSamples& samples, int first, VI marks) {
  std::int32_t* to = &samples.marks[static_cast<std::size_t>(first)];
  hn::StoreU(hn::Or(hn::LoadU(kI, to), marks), kI, to);
}

// Marks samples [a, a + kLanes) and their neighbours [b, b + kLanes) that show different things; the latter
// lie on `side` of the former, and these on `other_side` of them.
HWY_INLINE void mark_edges(EdgeSamples& samples, int a, int b, std::int32_t side, std::int32_t other_side,
                           float white) {
  const VI none = hn::Set(kI, EdgeSamples::kNone);
  const VI surface_a = hn::LoadU(kI, &samples.surface[static_cast<std::size_t>(a)]),
           surface_b = hn::LoadU(kI, &samples.surface[static_cast<std::size_t>(b)]);
  const MF known = hn::RebindMask(kF, hn::And(hn::Ne(surface_a, none), hn::Ne(surface_b, none)));
  const MF lit = hn::And(known, look_different(samples, a, b, white, kEdgeContrast));
  if (hn::AllFalse(kF, lit)) return;
  const SeenSurface at_a = seen_from(samples, a), at_b = seen_from(samples, b);
  const VI blocked_a = hn::LoadU(kI, &samples.blocked[static_cast<std::size_t>(a)]),
           blocked_b = hn::LoadU(kI, &samples.blocked[static_cast<std::size_t>(b)]);
  const MF one = on_one_surface(at_a, at_b);
  const MF shadow = hn::And(one, hn::RebindMask(kF, hn::Ne(blocked_a, blocked_b)));
  const MF shading =
      hn::And(hn::And(lit, hn::AndNot(shadow, one)), look_different(samples, a, b, white, kShadingContrast));
  const auto marked = [](MF where, std::int32_t as)
                          HWY_ATTR { return hn::IfThenElseZero(hn::RebindMask(kI, where), hn::Set(kI, as)); };
  const VI found = hn::Or(marked(hn::AndNot(one, lit), EdgeSamples::kSurfaceEdge),
                          hn::Or(marked(hn::And(shadow, lit), EdgeSamples::kShadowEdge),
                                 marked(shading, EdgeSamples::kShadingEdge)));
  const MF border = hn::And(hn::Or(hn::Not(one), shadow), lit);
  const MF strong = hn::And(border, look_different(samples, a, b, white, kStrongContrast));
  const VI marks = hn::Or(found, marked(strong, EdgeSamples::kStrongEdge));
  mark(samples, a, hn::Or(marks, marked(border, side * EdgeSamples::kFirstSide)));
  mark(samples, b, hn::Or(marks, marked(border, other_side * EdgeSamples::kFirstSide)));
}

// One of kLookEvery samples along a side of the tile asks for its neighbour in another tile, in the name of
// as many to the left and right.
constexpr int kLookEvery = 4;

// Marks samples (column, row) of the tile whose neighbours in another tile, (columns, rows) away, show
// another surface, and those around them along the side.
template <SurfaceDetail kDetail>
HWY_NOINLINE void look_outside(const TileJob& job, VI column, VI row, int columns, int rows, MF lanes) {
  EdgeSamples& samples = *job.scratch->edges;
  const RayGrid& grid = *job.grid;
  column = hn::IfThenElseZero(hn::RebindMask(kI, lanes), column);
  row = hn::IfThenElseZero(hn::RebindMask(kI, lanes), row);
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
  const MF wanted = lanes;
  lanes = hn::And(lanes, traceable(set3(grid.origin), direction));
  count_invalid(job, wanted, lanes);
  const SeenSurface met =
      trace_to_surface<kDetail>(job, direction, key_of(grid, x, y), spread_at(grid, x), lanes);
  const MF other = hn::AndNot(on_one_surface(own, met), lanes);
  if (hn::AllFalse(kF, other)) return;
  alignas(64) std::int32_t marks[kMaxLanes], at[kMaxLanes], place[kMaxLanes];
  const std::int32_t side = columns < 0   ? EdgePlaces::kLeft
                            : columns > 0 ? EdgePlaces::kRight
                            : rows < 0    ? EdgePlaces::kAbove
                                          : EdgePlaces::kBelow;
  const VI found =
      hn::Set(kI, EdgeSamples::kSurfaceEdge | EdgeSamples::kStrongEdge | side * EdgeSamples::kFirstSide);
  hn::Store(hn::IfThenElseZero(hn::RebindMask(kI, other), found), kI, marks);
  hn::Store(cells, kI, at);
  hn::Store(columns == 0 ? column : row, kI, place);
  const int along = columns == 0 ? 1 : EdgeSamples::kStride;
  for (int i = 0; i < kLanes; ++i) {
    if (marks[i] == 0) continue;
    const int last = std::min(kLookEvery / 2, kTileSide - 1 - place[i]);
    for (int step = std::max(-kLookEvery / 2, -place[i]); step <= last; ++step) {
      const auto cell = static_cast<std::size_t>(at[i] + step * along);
      if (samples.kind[cell] != static_cast<std::int32_t>(HitKind::none)) samples.marks[cell] |= marks[i];
    }
  }
}

// The four sides of the tile. Beyond the innermost and the outermost column there is nothing to see.
template <SurfaceDetail kDetail>
HWY_INLINE void look_around(const TileJob& job, int columns, int rows) {
  const auto places = [](int first, int count) HWY_ATTR {
    const VI place = hn::Mul(hn::Add(hn::Iota(kI, 0), hn::Set(kI, first)), hn::Set(kI, kLookEvery));
    return hn::Min(hn::Add(place, hn::Set(kI, kLookEvery / 2)), hn::Set(kI, count - 1));
  };
  const auto looks = [](int count) { return (count + kLookEvery - 1) / kLookEvery; };
  for (int first = 0; first < looks(columns); first += kLanes) {
    const VI column = places(first, columns);
    const MF lanes = first_lanes(looks(columns) - first);
    look_outside<kDetail>(job, column, hn::Zero(kI), 0, -1, lanes);
    look_outside<kDetail>(job, column, hn::Set(kI, rows - 1), 0, 1, lanes);
  }
  for (int first = 0; first < looks(rows); first += kLanes) {
    const VI row = places(first, rows);
    const MF lanes = first_lanes(looks(rows) - first);
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
      mark_edges(samples, at, at + 1, EdgePlaces::kRight, EdgePlaces::kLeft, white);
      mark_edges(samples, at, at + EdgeSamples::kStride, EdgePlaces::kBelow, EdgePlaces::kAbove, white);
    }
  }
  look_around<kDetail>(job, columns, rows);
  list_marked(samples, job.x0, job.y0);
  job.counters->edge_samples += samples.count;
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
