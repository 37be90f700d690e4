#include "renderer/bench/calibration_rays.h"

#include <tbb/version.h>

#include <cstdint>
#include <limits>

namespace herr {
namespace {

constexpr unsigned kQuads = 100;  // along each side: 2 * 100 * 100 triangles
constexpr int kJobsPerThread = 4;
constexpr int kColumns = 64, kRows = 64;  // rays of a job

// Heights of the ground, in [0, 1): any fixed pattern without order.
float height(unsigned x, unsigned z) {
  std::uint32_t h = x * 0x9E3779B1u ^ z * 0x85EBCA77u;
  h = (h ^ h >> 15) * 0x2C1B3C6Du;
  return static_cast<float>(h >> 8) * 0x1p-24f;
}

// Uneven ground of 100 m by 100 m.
void build_ground(RTCDevice device, RTCScene scene) {
  constexpr unsigned kCorners = kQuads + 1;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryMask(geometry, kAllMask);
  auto* corner =
      static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                  3 * sizeof(float), std::size_t{kCorners} * kCorners));
  auto* index =
      static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                     3 * sizeof(unsigned), std::size_t{2} * kQuads * kQuads));
  check_embree(device);
  for (unsigned z = 0; z < kCorners; ++z) {
    for (unsigned x = 0; x < kCorners; ++x) {
      *corner++ = static_cast<float>(x), *corner++ = 2 * height(x, z), *corner++ = static_cast<float>(z);
    }
  }
  for (unsigned z = 0; z < kQuads; ++z) {
    for (unsigned x = 0; x < kQuads; ++x) {
      const unsigned first = z * kCorners + x;
      for (const unsigned corner_index :
           {first, first + 1, first + kCorners, first + 1, first + kCorners + 1, first + kCorners}) {
        *index++ = corner_index;
      }
    }
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, 0);
  rtcReleaseGeometry(geometry);
}

// Packets of blocks of neighbours, 4 rays wide, from an eye above the middle of the ground.
template <int kRays>
std::size_t trace_block_rows(RTCScene scene, int job) {
  constexpr int kBlockRows = kRays / 4;
  alignas(64) typename RayPacket<kRays>::RayHit packet;
  alignas(64) int valid[16];
  std::size_t hits = 0;
  // Each job looks another way: turned about the vertical, as faces of a ring.
  const float slant = 0.05f + 0.02f * static_cast<float>(job % kJobsPerThread);
  for (int row = 0; row < kRows; row += kBlockRows) {
    for (int column = 0; column < kColumns; column += 4) {
      for (int i = 0; i < kRays; ++i) {
        const auto x = static_cast<float>(column + i % 4), y = static_cast<float>(row + i / 4);
        packet.ray.org_x[i] = 50.3f, packet.ray.org_y[i] = 30, packet.ray.org_z[i] = 49.6f;
        packet.ray.dir_x[i] = (x - 0.5f * kColumns) / kColumns + slant;
        packet.ray.dir_y[i] = -1;
        packet.ray.dir_z[i] = (y - 0.5f * kRows) / kRows - slant;
        packet.ray.tnear[i] = packet.ray.time[i] = 0;
        packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
        packet.ray.mask[i] = kAllMask;
        packet.ray.flags[i] = 0;
        packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        valid[i] = -1;
      }
      intersect_packet<kRays>(valid, scene, true, &packet);
      for (int i = 0; i < kRays; ++i) hits += packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    }
  }
  return hits;
}

std::string version_text(std::ptrdiff_t number) {
  return std::to_string(number / 10000) + '.' + std::to_string(number / 100 % 100) + '.' +
         std::to_string(number % 100);
}

}  // namespace

CalibrationRays::CalibrationRays(Isa isa, int threads)
    : isa_(isa), jobs_(kJobsPerThread * threads), device_(isa, threads), scene_(device_) {
  build_ground(device_.get(), scene_.get());
  scene_.commit();
}

std::size_t CalibrationRays::trace(int job) const {
  switch (isa_) {
    case Isa::avx512:
      return trace_block_rows<16>(scene_.get(), job);
    case Isa::avx2:
      return trace_block_rows<8>(scene_.get(), job);
    default:
      return trace_block_rows<4>(scene_.get(), job);
  }
}

std::string CalibrationRays::library_versions() const {
  const auto embree =
      static_cast<std::ptrdiff_t>(rtcGetDeviceProperty(device_.get(), RTC_DEVICE_PROPERTY_VERSION));
  return "Embree " + version_text(embree) + ", oneTBB " + TBB_runtime_version();
}

}  // namespace herr
