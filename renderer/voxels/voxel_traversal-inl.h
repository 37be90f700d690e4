// Rays through the octree of a grid, one ray a lane: from node to node of the level that the ray's
// width asks for, empty cubes in one step, colours composited front to back. Each step starts from the
// ray and the cube's whole coordinates, so that errors do not add up on the way. Method: Amanatides &
// Woo, "A Fast Voxel Traversal Algorithm" (1987), over Laine & Karras' cubes of any level ("Efficient
// Sparse Voxel Octrees", 2010).
#pragma once

#include "renderer/embree/footprint-inl.h"
#include "renderer/voxels/voxel_view.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// What passes below this share is taken for nothing.
constexpr float kOpaqueBelow = 1.0f / 256.0f;
// Nodes that hide are at most this many times as wide as the ray, for round outlines grow with them (by 0.02
// of a ray's width; 0.4 with half, for 4 % less time). Nodes that lend their colour are wider, for colours of
// narrow ones would flicker.
constexpr float kHidingPerWidth = 0.03125f;
constexpr float kColourPerWidth = 0.5f;
// A wide ray that starts on a surface passes over its first nodes, which stand for the surface itself: this
// many of the widest.
constexpr float kNodesPassedOver = 1.5f;
// A direction's component of less is taken for this: in 1e30 times the length of a grid it crosses no voxel.
constexpr float kSmallestDirection = 1e-30f;

// Rays in a grid's object space, that is, in voxels. The width is in voxels too: width + growth * t.
struct VoxelRays {
  V3 origin, direction;
  VF tnear, tfar, width, growth;
};

struct VoxelHits {
  VF t;        // of the node that shows most
  VI axis;     // 0, 1, 2: across which face the ray came into it
  VF passes;   // share of light that passes the whole grid up to tfar, in [0, 1]
  VF r, g, b;  // colour of the rest, linear light, weighted by it
};

struct V3i {
  VI x, y, z;
};

HWY_INLINE VI where(MF mask, VI yes, VI no) {
  return hn::IfThenElse(hn::RebindMask(kI, mask), yes, no);
}

// The march of one packet through one grid.
class VoxelMarch {
 public:
  HWY_INLINE VoxelMarch(const VoxelView& grid, const VoxelRays& rays) : grid_(grid), rays_(rays) {
    o_ = rays.origin;
    d_ = {steep(rays.direction.x), steep(rays.direction.y), steep(rays.direction.z)};
    const VF one = set(1.0f);
    inverse_ = {hn::Div(one, d_.x), hn::Div(one, d_.y), hn::Div(one, d_.z)};
    forward_x_ = hn::Gt(d_.x, hn::Zero(kF)), forward_y_ = hn::Gt(d_.y, hn::Zero(kF)),
    forward_z_ = hn::Gt(d_.z, hn::Zero(kF));
  }

  // Lanes of `active` that meet anything; what they meet in `out`.
  template <bool kColours>
  HWY_INLINE MF run(MF active, VoxelHits& out) {
    const VF zero = hn::Zero(kF);
    out = {zero, hn::Zero(kI), set(1.0f), zero, zero, zero};
    active = enter(active);
    if (hn::AllFalse(kF, active)) return active;
    shows_most_ = zero;
    run_passes_ = out.passes;
    // Only rays that start at a surface are so wide at their origin that nodes of
    // several voxels stand for it.
    const VF start =
        hn::Div(hn::Mul(set(kNodesPassedOver * kHidingPerWidth), rays_.width), hn::Sqrt(dot(d_, d_)));
    skipped_ = hn::IfThenElse(hn::Ge(rays_.width, set(2.0f / kHidingPerWidth)), start, set(-1.0f));
    while (!hn::AllFalse(kF, active)) active = step<kColours>(active, out);
    return hn::Lt(out.passes, set(1.0f));
  }

 private:
  static HWY_INLINE VF steep(VF d) {
    return hn::IfThenElse(hn::Lt(hn::Abs(d), set(kSmallestDirection)), set(kSmallestDirection), d);
  }
  static HWY_INLINE VI table(const std::array<std::int32_t, kMostVoxelLevels>& values, VI level) {
    return hn::GatherIndex(kI, values.data(), level);
  }

  // Where rays come into the grid's box, and by which face.
  HWY_INLINE MF enter(MF active) {
    const VF zero = hn::Zero(kF);
    const auto slab = [&](VF o, VF inverse, MF forward, std::int32_t count, VF& near, VF& far) HWY_ATTR {
      const VF at_lower = hn::Mul(hn::Sub(zero, o), inverse),
               at_upper = hn::Mul(hn::Sub(set(static_cast<float>(count)), o), inverse);
      near = hn::IfThenElse(forward, at_lower, at_upper);
      far = hn::IfThenElse(forward, at_upper, at_lower);
    };
    VF near_x, near_y, near_z, far_x, far_y, far_z;
    slab(o_.x, inverse_.x, forward_x_, grid_.counts[0], near_x, far_x);
    slab(o_.y, inverse_.y, forward_y_, grid_.counts[1], near_y, far_y);
    slab(o_.z, inverse_.z, forward_z_, grid_.counts[2], near_z, far_z);
    t_ = hn::Max(hn::Max(near_x, near_y), hn::Max(near_z, rays_.tnear));
    leave_ = hn::Min(hn::Min(far_x, far_y), hn::Min(far_z, rays_.tfar));
    active = hn::And(active, hn::Lt(t_, leave_));
    // The face: of the box, or for a ray that starts inside the one that it looks at most.
    const VF ax = hn::Abs(d_.x), ay = hn::Abs(d_.y), az = hn::Abs(d_.z);
    const MF inside = hn::Lt(hn::Max(hn::Max(near_x, near_y), near_z), t_);
    const MF by_x = hn::Eq(near_x, t_), by_y = hn::Eq(near_y, t_);
    const MF most_x = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az)), most_y = hn::Ge(ay, az);
    const VI one = hn::Set(kI, 1), two = hn::Set(kI, 2);
    const VI face = where(by_x, hn::Zero(kI), where(by_y, one, two));
    axis_ = where(inside, where(most_x, hn::Zero(kI), where(most_y, one, two)), face);
    const auto cell = [&](VF o, VF d, MF forward, std::int32_t count, std::int32_t axis) HWY_ATTR {
      const VF last = set(static_cast<float>(count - 1));
      const VF p = hn::Min(hn::Max(hn::Floor(hn::MulAdd(t_, d, o)), zero), last);
      const MF here = hn::AndNot(inside, hn::RebindMask(kF, hn::Eq(axis_, hn::Set(kI, axis))));
      return hn::ConvertTo(kI, hn::IfThenElse(here, hn::IfThenElse(forward, zero, last), p));
    };
    cell_ = {cell(o_.x, d_.x, forward_x_, grid_.counts[0], 0),
             cell(o_.y, d_.y, forward_y_, grid_.counts[1], 1),
             cell(o_.z, d_.z, forward_z_, grid_.counts[2], 2)};
    return active;
  }

  // The coarsest level whose nodes are at most `per_width` times as wide as the ray.
  HWY_INLINE VI level_at(VF t, float per_width) const {
    const VF width = hn::Max(hn::Mul(hn::MulAdd(rays_.growth, t, rays_.width), set(per_width)), set(1.0f));
    const VI exponent = hn::Sub(hn::ShiftRight<23>(hn::BitCast(kI, width)), hn::Set(kI, 127));
    return hn::Min(exponent, hn::Set(kI, grid_.top_level));
  }

  static HWY_INLINE VI gathered(const std::uint32_t* values, VI at) {
    return hn::GatherIndex(kI, reinterpret_cast<const std::int32_t*>(values), at);
  }

  static HWY_INLINE VI shifted(VI v, VI by) {
    return hn::BitCast(kI, hn::Shr(hn::BitCast(kU, v), hn::BitCast(kU, by)));
  }

  struct NodePlace {
    VI brick;  // below 0: nothing is there
    VI place;  // in the brick
  };

  // The node of a level that holds the cell; lanes that are not `used` get brick 0.
  HWY_INLINE NodePlace node_at(VI level, MF used) const {
    const VI three = hn::Set(kI, 3);
    const V3i node{shifted(cell_.x, level), shifted(cell_.y, level), shifted(cell_.z, level)};
    const VI block = hn::Add(hn::Add(table(grid_.first_block, level), hn::ShiftRight<2>(node.x)),
                             hn::Add(hn::Mul(hn::ShiftRight<2>(node.y), table(grid_.row, level)),
                                     hn::Mul(hn::ShiftRight<2>(node.z), table(grid_.slab, level))));
    const VI place = hn::Or(hn::And(node.x, three), hn::Or(hn::ShiftLeft<2>(hn::And(node.y, three)),
                                                           hn::ShiftLeft<4>(hn::And(node.z, three))));
    return {gathered(grid_.blocks, where(used, block, hn::Zero(kI))), place};
  }

  // One node or one empty cube of every ray.
  template <bool kColours>
  HWY_INLINE MF step(MF active, VoxelHits& out) {
    const VI level = level_at(t_, kHidingPerWidth), zero = hn::Zero(kI), one = hn::Set(kI, 1);
    const auto [brick, place] = node_at(level, active);
    const MF empty = hn::RebindMask(kF, hn::Lt(brick, zero));
    const MF bricked = hn::AndNot(empty, active);
    MF filled = bricked;
    if (!hn::AllFalse(kF, bricked)) {
      const VI word_at = hn::Add(hn::Add(brick, brick), hn::ShiftRight<5>(place));
      const VI word = gathered(grid_.masks, where(bricked, word_at, zero));
      const VI bit = hn::And(shifted(word, hn::And(place, hn::Set(kI, 31))), one);
      filled = hn::And(bricked, hn::RebindMask(kF, hn::Eq(bit, one)));
    }
    const VI doublings = hn::Add(hn::And(brick, hn::Set(kI, 31)), hn::Set(kI, 2));
    const VI size_log2 = hn::Add(level, where(empty, doublings, zero));
    const VI size = hn::Shl(one, size_log2);
    const V3i lower{hn::AndNot(hn::Sub(size, one), cell_.x), hn::AndNot(hn::Sub(size, one), cell_.y),
                    hn::AndNot(hn::Sub(size, one), cell_.z)};
    const auto wall = [&](VI low, VF o, VF inverse, MF forward) HWY_ATTR {
      const VI plane = hn::Add(low, where(forward, size, zero));
      return hn::Mul(hn::Sub(hn::ConvertTo(kF, plane), o), inverse);
    };
    const VF wall_x = wall(lower.x, o_.x, inverse_.x, forward_x_),
             wall_y = wall(lower.y, o_.y, inverse_.y, forward_y_),
             wall_z = wall(lower.z, o_.z, inverse_.z, forward_z_);
    const VF nearest = hn::Min(wall_x, hn::Min(wall_y, wall_z));
    const VF exit = hn::Max(nearest, t_);
    filled = hn::And(filled, hn::Ge(t_, skipped_));
    run_passes_ = hn::IfThenElse(filled, run_passes_, out.passes);
    if (!hn::AllFalse(kF, filled)) {
      active =
          meet<kColours>(active, filled, level, hn::Add(hn::ShiftLeft<6>(brick), place), size, exit, out);
    }
    return advance(active, {wall_x, wall_y, wall_z}, nearest, exit, lower, size);
  }

  // Across the nearest wall; the other coordinates stay within the cube that was left.
  HWY_INLINE MF advance(MF active, const V3& walls, VF nearest, VF exit, const V3i& lower, VI size) {
    const VI one = hn::Set(kI, 1);
    const MF by_x = hn::Eq(walls.x, nearest), by_y = hn::AndNot(by_x, hn::Eq(walls.y, nearest));
    const MF by_z = hn::Not(hn::Or(by_x, by_y));
    const VI last = hn::Sub(size, one);
    const bool large = !hn::AllTrue(kI, hn::Eq(size, one));
    MF within = active;
    const auto move = [&](VI cell, VI low, VF o, VF d, MF forward, MF crossed, std::int32_t count) HWY_ATTR {
      VI kept = cell;
      if (large) {
        const VF far = hn::ConvertTo(kF, hn::Add(low, last));
        const VF p = hn::Min(hn::Max(hn::Floor(hn::MulAdd(exit, d, o)), hn::ConvertTo(kF, low)), far);
        kept = hn::ConvertTo(kI, p);
      }
      const VI beyond = where(forward, hn::Add(low, size), hn::Sub(low, one));
      const VI to = where(crossed, beyond, kept);
      // As unsigned: what is below 0 is large.
      within = hn::And(
          within,
          hn::RebindMask(kF, hn::RebindMask(kI, hn::Lt(hn::BitCast(kU, to),
                                                       hn::Set(kU, static_cast<std::uint32_t>(count))))));
      return to;
    };
    cell_ = {move(cell_.x, lower.x, o_.x, d_.x, forward_x_, by_x, grid_.counts[0]),
             move(cell_.y, lower.y, o_.y, d_.y, forward_y_, by_y, grid_.counts[1]),
             move(cell_.z, lower.z, o_.z, d_.z, forward_z_, by_z, grid_.counts[2])};
    axis_ = where(by_x, hn::Zero(kI), where(by_y, one, hn::Set(kI, 2)));
    t_ = exit;
    return hn::And(within, hn::Lt(exit, leave_));
  }

  // Takes nodes into the composite; returns the rays that go on.
  template <bool kColours>
  HWY_INLINE MF meet(MF active, MF filled, VI level, VI at, VI size, VF exit, VoxelHits& out) {
    const VI low_byte = hn::Set(kI, 255);
    const MF in_grid = hn::And(filled, hn::RebindMask(kF, hn::Eq(level, hn::Zero(kI))));
    const MF above = hn::AndNot(in_grid, filled);
    VI opacities = hn::Set(kI, 0xffffff);
    if (!hn::AllFalse(kF, in_grid)) {
      const VI alpha = hn::And(hn::ShiftRight<24>(in_voxels(at, in_grid)), low_byte);
      opacities = hn::Or(alpha, hn::Or(hn::ShiftLeft<8>(alpha), hn::ShiftLeft<16>(alpha)));
    }
    if (!hn::AllFalse(kF, above)) {
      opacities = where(above, in_nodes(grid_.opacities, at, above), opacities);
    }
    VF opacity = set(1.0f);
    const MF solid = hn::RebindMask(kF, hn::Eq(opacities, hn::Set(kI, 0xffffff)));
    if (!hn::AllTrue(kF, hn::Or(solid, hn::Not(filled)))) {
      opacity = hn::IfThenElse(solid, opacity, opacity_along(opacities, size, exit));
    }
    // Nodes that follow one another are parts of one surface: what they hide adds up, and hides together what
    // came through before. Voxels themselves hide each for itself.
    run_passes_ = hn::IfThenElse(in_grid, out.passes, run_passes_);
    const VF weight = hn::IfThenElseZero(filled, hn::Min(hn::Mul(run_passes_, opacity), out.passes));
    const MF more = hn::Gt(weight, shows_most_);
    shows_most_ = hn::Max(shows_most_, weight);
    out.t = hn::IfThenElse(more, t_, out.t);
    out.axis = where(more, axis_, out.axis);
    if constexpr (kColours) {
      const VI rgba = colour_of(filled, level, at);
      const auto channel = [&](VI byte, VF sum) HWY_ATTR {
        return hn::MulAdd(weight, hn::GatherIndex(kF, grid_.linear_of_srgb, hn::And(byte, low_byte)), sum);
      };
      out.r = channel(rgba, out.r);
      out.g = channel(hn::ShiftRight<8>(rgba), out.g);
      out.b = channel(hn::ShiftRight<16>(rgba), out.b);
    }
    out.passes = hn::Sub(out.passes, weight);
    const MF done = hn::Lt(out.passes, set(kOpaqueBelow));
    out.passes = hn::IfThenZeroElse(done, out.passes);
    return hn::AndNot(done, active);
  }

  // What nodes lend: the mean of the node about them that is as wide as the ray asks for.
  HWY_INLINE VI colour_of(MF filled, VI level, VI at) const {
    const VI coarse = level_at(t_, kColourPerWidth);
    if (!hn::AllTrue(kF, hn::Or(hn::Not(filled), hn::RebindMask(kF, hn::Eq(coarse, level))))) {
      const auto [brick, place] = node_at(coarse, filled);
      at = hn::Add(hn::ShiftLeft<6>(brick), place);
    }
    const MF in_grid = hn::And(filled, hn::RebindMask(kF, hn::Eq(coarse, hn::Zero(kI))));
    const MF above = hn::AndNot(in_grid, filled);
    VI rgba = hn::Zero(kI);
    if (!hn::AllFalse(kF, in_grid)) rgba = in_voxels(at, in_grid);
    if (!hn::AllFalse(kF, above)) rgba = where(above, in_nodes(grid_.colours, at, above), rgba);
    return rgba;
  }

  HWY_INLINE VI in_voxels(VI at, MF used) const {
    return gathered(grid_.voxels, where(used, at, hn::Zero(kI)));
  }

  // `values` begin with the first brick above the voxels.
  HWY_INLINE VI in_nodes(const std::uint32_t* values, VI at, MF used) const {
    return gathered(values,
                    where(used, hn::Sub(at, hn::Set(kI, grid_.first_upper_brick * 64)), hn::Zero(kI)));
  }

  // The share of a ray that meets something on its way through a node. Along each axis it crosses
  // a part of the node, and meets that part of what the node hides; what hides along different
  // axes hides independently.
  HWY_INLINE VF opacity_along(VI opacities, VI size, VF exit) const {
    const VF way = hn::Div(hn::Sub(hn::Min(exit, leave_), t_), hn::ConvertTo(kF, size));
    const auto passes = [&](VI byte, VF d) HWY_ATTR {
      const VF hides = hn::Mul(hn::ConvertTo(kF, hn::And(byte, hn::Set(kI, 255))), set(1.0f / 255.0f));
      return hn::NegMulAdd(hides, hn::Min(hn::Mul(way, hn::Abs(d)), set(1.0f)), set(1.0f));
    };
    return hn::NegMulAdd(hn::Mul(passes(opacities, d_.x), passes(hn::ShiftRight<8>(opacities), d_.y)),
                         passes(hn::ShiftRight<16>(opacities), d_.z), set(1.0f));
  }

  const VoxelView& grid_;
  const VoxelRays& rays_;
  V3 o_, d_, inverse_;
  MF forward_x_, forward_y_, forward_z_;
  VF t_, leave_, shows_most_, skipped_;
  VF run_passes_;  // what came through before the run of nodes in work
  VI axis_;
  V3i cell_;
};

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
