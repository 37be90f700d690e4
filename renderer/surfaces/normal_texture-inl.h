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

// Directions of a triangle at `lanes`, in object space: unit, each across the others.
struct TangentFrame {
  V3 normal, tangent, bitangent;
  MF known;  // where the corners' tangents say a direction
};

HWY_INLINE TangentFrame tangent_frame(const InstanceRecord& instance, VI record, const Barycentric& at) {
  const TangentRecord* records = instance.detail->tangents;
  const V3 n = normalise(
      interpolate_directions(reinterpret_cast<const std::uint32_t*>(instance.triangles), record, at));
  // A record of tangents is half as long as a triangle's.
  const VI tangents = hn::ShiftRight<1>(record);
  const V3 along = interpolate_directions(reinterpret_cast<const std::uint32_t*>(records), tangents, at);
  const VF handedness = hn::GatherIndex(kF, reinterpret_cast<const float*>(records) + 3, tangents);
  const V3 across = mul_add(hn::Neg(dot(n, along)), n, along);
  const V3 t = normalise(across);
  return {n, t, scale(cross(n, t), handedness), hn::Gt(dot(across, across), set(kLeastTangent2))};
}

// Shading normals as a texture bends them, from those that store_normals left in `out`. A slope that would
// face away from the viewer is hidden by the bump that it belongs to: it is taken for the one that faces the
// viewer as much. They stay as they are where a bent one would face away from the triangle's own side, so
// light is always in front of both, and where the tangents say no direction.
HWY_INLINE V3 bent_normals(const InstanceRecord& instance, const TextureUse& texture, float factor, VI record,
                           const Barycentric& at, VF object_width2, MF lanes, const HitBatch& out, int slot) {
  const Rgba texel = fetch_use(texture, record, at, object_width2, lanes);
  const VF two = set(2.0f), one = set(1.0f);
  const VF x = hn::Mul(hn::MulSub(two, texel.r, one), set(factor)),
           y = hn::Mul(hn::MulSub(two, texel.g, one), set(factor)), z = hn::MulSub(two, texel.b, one);
  const TangentFrame frame = tangent_frame(instance, record, at);
  V3 bent = normal_to_world(instance,
                            mul_add(x, frame.tangent, mul_add(y, frame.bitangent, scale(frame.normal, z))));

  // What was turned to the viewer is turned with its texture.
  const V3 plain = load3(out.normal, slot);
  const V3 g = load3(out.geometric_normal, slot);
  const MF turned = hn::Lt(dot(normal_to_world(instance, frame.normal), plain), hn::Zero(kF));
  bent = select(turned, scale(bent, set(-1.0f)), bent);
  const V3 viewer = load3(out.viewer, slot);
  const VF away = hn::Max(hn::Neg(dot(bent, viewer)), hn::Zero(kF));
  bent = mul_add(hn::Mul(two, away), viewer, bent);
  const MF bends = hn::And(frame.known, hn::Gt(dot(bent, g), hn::Zero(kF)));
  return select(bends, bent, plain);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
