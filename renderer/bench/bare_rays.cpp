#include "renderer/bench/bare_rays.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace herr {
namespace {

template <int kRays, typename Ray>
void fill(const RecordedRays& rays, std::size_t first, std::size_t count, float tfar, unsigned mask,
          Ray& packet, int* valid) {
  const std::size_t bytes = count * sizeof(float);
  std::memcpy(packet.org_x, &rays.ox[first], bytes);
  std::memcpy(packet.org_y, &rays.oy[first], bytes);
  std::memcpy(packet.org_z, &rays.oz[first], bytes);
  std::memcpy(packet.dir_x, &rays.dx[first], bytes);
  std::memcpy(packet.dir_y, &rays.dy[first], bytes);
  std::memcpy(packet.dir_z, &rays.dz[first], bytes);
  for (std::size_t i = 0; i < kRays; ++i) {
    packet.tnear[i] = 0;
    packet.tfar[i] = tfar;
    packet.mask[i] = mask;
    packet.flags[i] = 0;
    packet.id[i] = i < count ? rays.footprint[first + i] : 0;
    packet.time[i] = i < count ? rays.chance[first + i] : 0;
    valid[i] = i < count && !rays.is_gap(first + i) ? -1 : 0;
  }
}

template <int kRays>
std::size_t trace_packets(RTCScene scene, RayKind kind, const RecordedRays& rays, std::size_t first,
                          std::size_t count) {
  const bool probe = kind == RayKind::probe || kind == RayKind::catcher_probe;
  const bool closest = probe || kind == RayKind::primary || kind == RayKind::behind ||
                       kind == RayKind::edge || kind == RayKind::mirror || kind == RayKind::refraction;
  const bool past_objects = kind == RayKind::catcher_shadow || kind == RayKind::catcher_occlusion ||
                            kind == RayKind::catcher_probe || kind == RayKind::catcher_probe_shadow;
  const unsigned mask = past_objects ? kCatcherMask : kAllMask;
  alignas(64) typename RayPacket<kRays>::RayHit packet;
  alignas(64) int valid[16];
  std::size_t hits = 0;
  for (std::size_t at = first; at < first + count; at += kRays) {
    const std::size_t lanes = std::min<std::size_t>(kRays, first + count - at);
    if (closest) {
      fill<kRays>(rays, at, lanes, std::numeric_limits<float>::infinity(), mask, packet.ray, valid);
      std::fill_n(packet.hit.geomID, kRays, RTC_INVALID_GEOMETRY_ID);
      std::fill_n(packet.hit.instID[0], kRays, RTC_INVALID_GEOMETRY_ID);
      intersect_packet<kRays>(valid, scene, !probe, &packet);
      for (std::size_t i = 0; i < lanes; ++i) hits += packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    } else {
      fill<kRays>(rays, at, lanes, kShadowRayEnd, mask, packet.ray, valid);
      occluded_packet<kRays>(valid, scene, &packet.ray);
      for (std::size_t i = 0; i < lanes; ++i) hits += packet.ray.tfar[i] < 0;
    }
  }
  return hits;
}

}  // namespace

std::size_t trace_bare(Isa isa, RTCScene scene, RayKind kind, const RecordedRays& rays, std::size_t first,
                       std::size_t count) {
  switch (isa) {
    case Isa::avx512:
      return trace_packets<16>(scene, kind, rays, first, count);
    case Isa::avx2:
      return trace_packets<8>(scene, kind, rays, first, count);
    default:
      return trace_packets<4>(scene, kind, rays, first, count);
  }
}

}  // namespace herr
