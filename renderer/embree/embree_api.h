// The one place that knows which Embree this is: version 3 (Debian 12) or 4, and packets of 4, 8 or
// 16 rays. Occlusion packets never carry the COHERENT flag: rtcOccluded16 of Embree 3.13 does not
// return with it on AVX-512.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace herr {

inline constexpr unsigned kObjectMask = 1;   // virtual objects
inline constexpr unsigned kCatcherMask = 2;  // stand-ins for real surfaces
inline constexpr unsigned kAllMask = ~0u;

// Shadow rays run from a surface to a light, t in [0, 1], and end just short of it: what touches the light's
// sample point does not shadow it by rounding.
inline constexpr float kShadowRayEnd = 1.0f - 0x1p-12f;

template <int kRays>
struct RayPacket;
template <>
struct RayPacket<4> {
  using Ray = RTCRay4;
  using RayHit = RTCRayHit4;
};
template <>
struct RayPacket<8> {
  using Ray = RTCRay8;
  using RayHit = RTCRayHit8;
};
template <>
struct RayPacket<16> {
  using Ray = RTCRay16;
  using RayHit = RTCRayHit16;
};

// Bits of a ray's flags, which Embree carries and does not read. What hit filters (alpha_filter) do with it:
inline constexpr unsigned kCullBackFaces = 1;  // skips back faces where the instance asks for that
inline constexpr unsigned kSecondLook = 2;     // blended surfaces are there where they cover at least half
inline constexpr unsigned kPassesThrough = 4;  // an occlusion ray of trace_passing: the lane in bits 8 ...
inline constexpr unsigned kLaneShift = 8;

#if RTC_VERSION_MAJOR >= 4

// The share of light that passes the blended surfaces which the rays of an occlusion packet met.
struct PassingContext {
  RTCRayQueryContext context;
  float passes[16];
};
inline float* passes_of(const RTCFilterFunctionNArguments& args) {
  return reinterpret_cast<PassingContext*>(args.context)->passes;
}

// As occluded_packet, for rays with kPassesThrough.
template <int kRays>
inline void passing_packet(const int* valid, RTCScene scene, typename RayPacket<kRays>::Ray* rays,
                           PassingContext& passing) {
  rtcInitRayQueryContext(&passing.context);
  RTCOccludedArguments args;
  rtcInitOccludedArguments(&args);
  args.context = &passing.context;
  if constexpr (kRays == 16) rtcOccluded16(valid, scene, rays, &args);
  if constexpr (kRays == 8) rtcOccluded8(valid, scene, rays, &args);
  if constexpr (kRays == 4) rtcOccluded4(valid, scene, rays, &args);
}

template <int kRays>
inline void intersect_packet(const int* valid, RTCScene scene, bool coherent,
                             typename RayPacket<kRays>::RayHit* rays) {
  RTCIntersectArguments args;
  rtcInitIntersectArguments(&args);
  args.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  if constexpr (kRays == 16) rtcIntersect16(valid, scene, rays, &args);
  if constexpr (kRays == 8) rtcIntersect8(valid, scene, rays, &args);
  if constexpr (kRays == 4) rtcIntersect4(valid, scene, rays, &args);
}

template <int kRays>
inline void occluded_packet(const int* valid, RTCScene scene, typename RayPacket<kRays>::Ray* rays) {
  RTCOccludedArguments args;
  rtcInitOccludedArguments(&args);
  if constexpr (kRays == 16) rtcOccluded16(valid, scene, rays, &args);
  if constexpr (kRays == 8) rtcOccluded8(valid, scene, rays, &args);
  if constexpr (kRays == 4) rtcOccluded4(valid, scene, rays, &args);
}

#else

struct PassingContext {
  RTCIntersectContext context;
  float passes[16];
};
inline float* passes_of(const RTCFilterFunctionNArguments& args) {
  return reinterpret_cast<PassingContext*>(args.context)->passes;
}

template <int kRays>
inline void passing_packet(const int* valid, RTCScene scene, typename RayPacket<kRays>::Ray* rays,
                           PassingContext& passing) {
  rtcInitIntersectContext(&passing.context);
  if constexpr (kRays == 16) rtcOccluded16(valid, scene, &passing.context, rays);
  if constexpr (kRays == 8) rtcOccluded8(valid, scene, &passing.context, rays);
  if constexpr (kRays == 4) rtcOccluded4(valid, scene, &passing.context, rays);
}

template <int kRays>
inline void intersect_packet(const int* valid, RTCScene scene, bool coherent,
                             typename RayPacket<kRays>::RayHit* rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  if constexpr (kRays == 16) rtcIntersect16(valid, scene, &context, rays);
  if constexpr (kRays == 8) rtcIntersect8(valid, scene, &context, rays);
  if constexpr (kRays == 4) rtcIntersect4(valid, scene, &context, rays);
}

template <int kRays>
inline void occluded_packet(const int* valid, RTCScene scene, typename RayPacket<kRays>::Ray* rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if constexpr (kRays == 16) rtcOccluded16(valid, scene, &context, rays);
  if constexpr (kRays == 8) rtcOccluded8(valid, scene, &context, rays);
  if constexpr (kRays == 4) rtcOccluded4(valid, scene, &context, rays);
}

#endif

}  // namespace herr
