#include "renderer/geometry/alpha_filter.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

namespace herr {
namespace {

constexpr float kInvisible = 1.0f / 255.0f;

float unorm(std::uint32_t word, bool high) {
  return static_cast<float>(high ? word >> 16 : word & 0xffffu);
}

// Index of texel `i` of `size` in a row, by the wrap mode.
int wrapped(int i, int size, std::uint8_t wrap) {
  if (wrap == static_cast<std::uint8_t>(TextureWrap::clamp)) return std::clamp(i, 0, size - 1);
  if (wrap == static_cast<std::uint8_t>(TextureWrap::repeat)) return (i % size + size) % size;
  const int folded = (i % (2 * size) + 2 * size) % (2 * size);
  return folded < size ? folded : 2 * size - 1 - folded;
}

// Alpha of the nearest level that is no finer than the ray is wide, bilinear.
float fetch_alpha(const TextureUse& use, std::uint32_t triangle, float u, float v, float width2) {
  const TextureRecord& texture = *use.texture;
  const TriangleRecord& record = use.coordinates[triangle];
  const float w = 1.0f - u - v;
  float place[2];
  for (int axis = 0; axis < 2; ++axis) {
    const bool high = axis == 1;
    const float q =
        w * unorm(record.uv[0], high) + u * unorm(record.uv[1], high) + v * unorm(record.uv[2], high);
    place[axis] = use.uv_lower[axis] + use.uv_scale[axis] * q;
  }
  const float texels2 =
      width2 * record.texel_density * static_cast<float>(texture.width) * static_cast<float>(texture.height);
  const int level = texels2 > 1 ? std::clamp(std::ilogb(texels2) / 2, 0, texture.levels - 1) : 0;
  const int width = std::max(1, texture.width >> level), height = std::max(1, texture.height >> level);
  const std::uint32_t* texels = texture.rgba8 + texture.first_texel[static_cast<std::size_t>(level)];
  // A coordinate so far out that its texel has no number reads texel 0.
  const auto in_range = [](float x) { return std::abs(x) < 1e9f ? x : 0.0f; };
  float x = in_range(place[0] * static_cast<float>(width)),
        y = in_range(place[1] * static_cast<float>(height));
  if (!(texture.nearest && level == 0)) x -= 0.5f, y -= 0.5f;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const auto alpha = [&](int column, int row) {
    const auto at =
        static_cast<std::size_t>(wrapped(row, height, texture.wrap_v)) * static_cast<std::size_t>(width) +
        static_cast<std::size_t>(wrapped(column, width, texture.wrap_u));
    return static_cast<float>(texels[at] >> 24) * (1.0f / 255.0f);
  };
  if (texture.nearest && level == 0) return alpha(x0, y0);
  const float tx = x - static_cast<float>(x0), ty = y - static_cast<float>(y0);
  const float top = alpha(x0, y0) + tx * (alpha(x0 + 1, y0) - alpha(x0, y0));
  const float below = alpha(x0, y0 + 1) + tx * (alpha(x0 + 1, y0 + 1) - alpha(x0, y0 + 1));
  return top + ty * (below - top);
}

// Half a float's bits, as rays carry their width and its growth in their id.
float half_code(std::uint32_t bits) {
  return std::bit_cast<float>(bits << 15);
}

struct Hit {
  const InstanceRecord* instance;
  std::uint32_t triangle;
  float u, v, facing;  // facing < 0: from the front
  unsigned flags;
  float width2;
};

// Area in object space of a square metre of the face that is hit, as surfaces/normals has it.
float face_per_world2(const InstanceRecord& instance, const RTCFilterFunctionNArguments& args, unsigned i) {
  if (instance.face_per_world2 == 0) return instance.object_per_world2;
  const glm::vec3 n =
      glm::normalize(glm::vec3(RTCHitN_Ng_x(args.hit, args.N, i), RTCHitN_Ng_y(args.hit, args.N, i),
                               RTCHitN_Ng_z(args.hit, args.N, i)));
  const float* m = instance.normal_from_object;
  const glm::vec3 turned{m[0] * n.x + m[1] * n.y + m[2] * n.z, m[3] * n.x + m[4] * n.y + m[5] * n.z,
                         m[6] * n.x + m[7] * n.y + m[8] * n.z};
  const float length = glm::length(turned);
  return length > 0 ? instance.face_per_world2 / length : instance.object_per_world2;
}

Hit hit_of(const RTCFilterFunctionNArguments& args, unsigned i) {
  const auto& table = *static_cast<const InstanceTable*>(args.geometryUserPtr);
  const unsigned n = args.N;
  Hit hit{};
  hit.instance = &table.records[RTCHitN_instID(args.hit, n, i, 0)];
  hit.triangle = RTCHitN_primID(args.hit, n, i);
  hit.u = RTCHitN_u(args.hit, n, i);
  hit.v = RTCHitN_v(args.hit, n, i);
  hit.facing = RTCHitN_Ng_x(args.hit, n, i) * RTCRayN_dir_x(args.ray, n, i) +
               RTCHitN_Ng_y(args.hit, n, i) * RTCRayN_dir_y(args.ray, n, i) +
               RTCHitN_Ng_z(args.hit, n, i) * RTCRayN_dir_z(args.ray, n, i);
  hit.flags = RTCRayN_flags(args.ray, n, i);
  const std::uint32_t code = RTCRayN_id(args.ray, n, i);
  const float width = half_code(code & 0xffffu) + half_code(code >> 16) * RTCRayN_tfar(args.ray, n, i);
  hit.width2 = code != 0 ? width * width * face_per_world2(*hit.instance, args, i) : 0.0f;
  return hit;
}

float alpha_of(const Hit& hit) {
  return alpha_at(*hit.instance->detail, hit.triangle, hit.u, hit.v, hit.width2);
}

bool has_holes(const Hit& hit) {
  return hit.instance->detail != nullptr && hit.instance->detail->alpha_mode != AlphaMode::opaque;
}

bool stops(const Hit& hit) {
  if ((hit.flags & kCullBackFaces) != 0 && hit.instance->back_face_culling && hit.facing > 0) return false;
  if (!has_holes(hit)) return true;
  const DetailRecord& detail = *hit.instance->detail;
  if (detail.alpha_mode == AlphaMode::mask) return alpha_of(hit) >= detail.alpha_cutoff;
  return alpha_of(hit) >= ((hit.flags & kSecondLook) != 0 ? 0.5f : kInvisible);
}

void filter_closest(const RTCFilterFunctionNArguments* args) {
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == -1 && !stops(hit_of(*args, i))) args->valid[i] = 0;
  }
}

void filter_occlusion(const RTCFilterFunctionNArguments* args) {
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    Hit hit = hit_of(*args, i);
    const bool blended = has_holes(hit) && hit.instance->detail->alpha_mode == AlphaMode::blend;
    if (blended && (hit.flags & kPassesThrough) != 0) {
      passes_of(*args)[hit.flags >> kLaneShift] *= 1.0f - std::clamp(alpha_of(hit), 0.0f, 1.0f);
      args->valid[i] = 0;
      continue;
    }
    hit.flags = kSecondLook;
    if (!stops(hit)) args->valid[i] = 0;
  }
}

}  // namespace

float alpha_at(const DetailRecord& detail, std::uint32_t triangle, float u, float v, float width2) {
  float alpha = detail.alpha;
  if (detail.colours != nullptr) {
    const ColourRecord& colours = detail.colours[triangle];
    const float sum = (1.0f - u - v) * unorm(colours.rgba[1], true) + u * unorm(colours.rgba[3], true) +
                      v * unorm(colours.rgba[5], true);
    alpha *= sum * (1.0f / 65535.0f);
  }
  if (detail.coverage.texture != nullptr) alpha *= fetch_alpha(detail.coverage, triangle, u, v, width2);
  return alpha;
}

void filter_hits(RTCGeometry geometry, const InstanceTable& instances) {
  rtcSetGeometryUserData(geometry, const_cast<InstanceTable*>(&instances));
  rtcSetGeometryIntersectFilterFunction(geometry, filter_closest);
  rtcSetGeometryOccludedFilterFunction(geometry, filter_occlusion);
}

}  // namespace herr
