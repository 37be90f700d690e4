// Clear coat, sheen and stretched highlights of hits: HitBatch::lobes, where the plan has them. Before:
// normals. After: lighting adds the lobes. Source: KHR_materials_clearcoat, _sheen, _anisotropy.
#pragma once

#include "renderer/surfaces/normal_texture-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

constexpr float kSmallestAlpha = 1e-3f;    // keeps a highlight's peak, 1 / (pi alpha^2), finite in float
constexpr float kLeastDirection2 = 1e-3f;  // squared length of a direction in a texture; less is none

// A coat lies on the surface before its normal texture bends it, and may have a texture of its own.
HWY_INLINE void store_coat_normal(const InstanceRecord& instance, VI record, const Barycentric& at,
                                  VF object_width2, MF lanes, HitBatch& out, int slot) {
  V3 n = load3(out.normal, slot);
  if (instance.detail && instance.detail->lobes.coat_normal.texture != nullptr) {
    const LobeRecord& from = instance.detail->lobes;
    n = bent_normals(instance, from.coat_normal, from.coat_normal_scale, record, at, object_width2, lanes,
                     out, slot);
  }
  store_lanes(n, lanes, out.lobes->coat_normal, slot);
}

// Any unit direction across a unit normal. Source: Duff et al., "Building an Orthonormal Basis, Revisited"
// (2017).
HWY_INLINE V3 direction_across(const V3& n) {
  const VF sign = hn::CopySign(set(1.0f), n.z);
  const VF a = hn::Div(set(-1.0f), hn::Add(sign, n.z));
  const VF x = hn::Mul(sign, n.x);
  return {hn::MulAdd(hn::Mul(x, n.x), a, set(1.0f)), hn::Mul(hn::Mul(x, n.y), a), hn::Neg(x)};
}

// Along which way, and how much, the highlight of `lanes` is stretched.
HWY_INLINE void store_stretch(const InstanceRecord& instance, VI record, const Barycentric& at,
                              VF object_width2, MF lanes, HitBatch& out, int slot) {
  const V3 shading = load3(out.normal, slot);
  V3 along = direction_across(shading);
  VF stretch = hn::Zero(kF);
  if (instance.detail && instance.detail->tangents != nullptr && instance.detail->lobes.stretch > 0) {
    const LobeRecord& from = instance.detail->lobes;
    VF x = set(1.0f), y = hn::Zero(kF);
    stretch = set(from.stretch);
    if (from.stretch_texture.texture != nullptr) {
      const Rgba texel = fetch_use(from.stretch_texture, record, at, object_width2, lanes);
      x = hn::MulSub(set(2.0f), texel.r, set(1.0f));
      y = hn::MulSub(set(2.0f), texel.g, set(1.0f));
      stretch = hn::Mul(stretch, texel.b);
    }
    const VF turned_x = hn::MulSub(x, set(from.stretch_cos), hn::Mul(y, set(from.stretch_sin)));
    const VF turned_y = hn::MulAdd(x, set(from.stretch_sin), hn::Mul(y, set(from.stretch_cos)));
    // Where normals go by the inverse transpose N, a direction a x b goes along N a x N b.
    const TangentFrame frame = tangent_frame(instance, record, at);
    const V3 across = sub(scale(frame.bitangent, turned_x), scale(frame.tangent, turned_y));
    const V3 way = cross(normal_to_world(instance, across), normal_to_world(instance, frame.normal));
    const V3 flat = mul_add(hn::Neg(dot(shading, way)), shading, way);
    const MF known = hn::And(hn::And(frame.known, hn::Gt(dot(flat, flat), set(kLeastTangent2))),
                             hn::Gt(hn::MulAdd(x, x, hn::Mul(y, y)), set(kLeastDirection2)));
    along = select(known, normalise(flat), along);
    stretch = hn::IfThenElseZero(known, stretch);
  }
  store_lanes(along, lanes, out.lobes->tangent, slot);
  store_lanes(stretch, lanes, out.lobes->stretch.data() + slot);
}

// Surfaces without a lobe get one of no strength.
HWY_INLINE void store_lobes(const InstanceRecord& instance, VI record, const Barycentric& at,
                            VF object_width2, MF lanes, HitBatch& out, int slot) {
  const LobeRecord& from = instance.detail ? instance.detail->lobes : kNoLobes;
  const auto put = [&](VF value, Lane<float>& lane)
                       HWY_ATTR { store_lanes(value, lanes, lane.data() + slot); };
  const auto alpha_of = [](VF roughness)
                            HWY_ATTR { return hn::Max(hn::Mul(roughness, roughness), set(kSmallestAlpha)); };
  const auto fetch = [&](const TextureUse& use)
                         HWY_ATTR { return fetch_use(use, record, at, object_width2, lanes); };
  VF coat = set(from.coat), coat_roughness = set(from.coat_roughness);
  if (from.coat_texture.texture != nullptr) coat = hn::Mul(coat, fetch(from.coat_texture).r);
  if (from.coat_roughness_texture.texture != nullptr)
    coat_roughness = hn::Mul(coat_roughness, fetch(from.coat_roughness_texture).g);
  const VF coat_alpha = alpha_of(coat_roughness);
  put(coat, out.lobes->coat);
  put(hn::Mul(coat_alpha, coat_alpha), out.lobes->coat_alpha2);

  V3 sheen = set3(from.sheen);
  VF sheen_roughness = set(from.sheen_roughness);
  if (from.sheen_texture.texture != nullptr) {
    const Rgba texel = fetch(from.sheen_texture);
    sheen = {hn::Mul(sheen.x, texel.r), hn::Mul(sheen.y, texel.g), hn::Mul(sheen.z, texel.b)};
  }
  if (from.sheen_roughness_texture.texture != nullptr)
    sheen_roughness = hn::Mul(sheen_roughness, fetch(from.sheen_roughness_texture).a);
  store_lanes(sheen, lanes, out.lobes->sheen, slot);
  put(alpha_of(sheen_roughness), out.lobes->sheen_alpha);
  store_stretch(instance, record, at, object_width2, lanes, out, slot);
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
