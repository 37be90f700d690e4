// Normal textures: shading normals bent by directions in tangent space. All of it happens in object space, so
// that matrices which mirror or stretch treat what the texture shows as they treat the mesh itself.
// Source: glTF 2.0 sections 3.7.2.1 and 3.9.3.
#pragma once

#include "renderer/surfaces/normals-inl.h"
#include "renderer/surfaces/surface_details-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

constexpr float kLeastTangent2 = 1e-7f;  // squared, of a tangent across its normal; less may be rounding

// Replaces the shading normals of `lanes`, which store_normals left in `out`. A slope that would face away
// from the viewer is hidden by the bump that it belongs to: it is taken for the one that faces the viewer as
// much. They stay as they are where a bent one would face away from the triangle's own side, so light is
// always in front of both, and where the tangents say no direction.
HWY_INLINE void bend_normals(const InstanceRecord& instance, VI record, const Barycentric& at,
                             VF object_width2, MF lanes, HitBatch& out, int slot) {
  const DetailRecord& detail = *instance.detail;
  const Rgba texel = fetch_use(detail.normal, record, at, object_width2, lanes);
  const VF two = set(2.0f), one = set(1.0f);
  const VF x = hn::Mul(hn::MulSub(two, texel.r, one), set(detail.normal_scale)),
           y = hn::Mul(hn::MulSub(two, texel.g, one), set(detail.normal_scale)),
           z = hn::MulSub(two, texel.b, one);

  const V3 n = normalise(
      interpolate_directions(reinterpret_cast<const std::uint32_t*>(instance.triangles), record, at));
  // A record of tangents is half as long as a triangle's.
  const auto* words = reinterpret_cast<const std::uint32_t*>(detail.tangents);
  const VI tangents = hn::ShiftRight<1>(record);
  const V3 along = interpolate_directions(words, tangents, at);
  const VF handedness = hn::GatherIndex(kF, reinterpret_cast<const float*>(detail.tangents) + 3, tangents);
  const V3 across = mul_add(hn::Neg(dot(n, along)), n, along);
  const V3 t = normalise(across);
  const V3 b = scale(cross(n, t), handedness);
  V3 bent = normal_to_world(instance, mul_add(x, t, mul_add(y, b, scale(n, z))));

  // What was turned to the viewer is turned with its texture.
  const V3 plain = load3(out.normal, slot);
  const V3 g = load3(out.geometric_normal, slot);
  const MF turned = hn::Lt(dot(normal_to_world(instance, n), plain), hn::Zero(kF));
  bent = select(turned, scale(bent, set(-1.0f)), bent);
  const V3 viewer = load3(out.viewer, slot);
  const VF away = hn::Max(hn::Neg(dot(bent, viewer)), hn::Zero(kF));
  bent = mul_add(hn::Mul(two, away), viewer, bent);
  const MF bends = hn::And(hn::And(lanes, hn::Gt(dot(bent, g), hn::Zero(kF))),
                           hn::Gt(dot(across, across), set(kLeastTangent2)));
  store_lanes(bent, bends, out.normal, slot);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
