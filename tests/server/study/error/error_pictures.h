// Small viewports and pictures for tests of errors, and work spread over threads.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "server/study/error/linear_picture.h"
#include "server/study/error/picture_errors.h"

namespace herr::test {

inline ParallelFor on_threads(int threads) {
  return [threads](int count, const std::function<void(int)>& work) {
    std::atomic<int> next{0};
    const auto take = [&] {
      for (int i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::thread> others;
    for (int t = 1; t < threads; ++t) others.emplace_back(take);
    take();
    for (std::thread& thread : others) thread.join();
  };
}

inline glm::dvec3 gaze_at(double right_deg, double up_deg = 0) {
  const double x = glm::radians(right_deg), y = glm::radians(up_deg);
  return {std::sin(x) * std::cos(y), std::sin(y), -std::cos(x) * std::cos(y)};
}

inline Viewport plain_viewport(int width_px, int height_px, double half_width_deg, double half_height_deg) {
  Viewport v;
  v.name = "plain";
  v.width_px = width_px;
  v.height_px = height_px;
  v.tan_right = std::tan(glm::radians(half_width_deg));
  v.tan_up = std::tan(glm::radians(half_height_deg));
  v.tan_left = -v.tan_right;
  v.tan_down = -v.tan_up;
  return v;
}

inline DisplayProfile plain_profile(int width_px, int height_px, double half_width_deg,
                                    double half_height_deg) {
  return {"plain", 60, {plain_viewport(width_px, height_px, half_width_deg, half_height_deg)}};
}

// xr1 with a tenth of the pixels along each axis.
inline DisplayProfile tenth_profile() {
  DisplayProfile profile = xr1_profile();
  for (Viewport& v : profile.viewports) {
    v.width_px /= 10;
    v.height_px /= 10;
  }
  return profile;
}

inline std::vector<ViewportMap> maps_of(const DisplayProfile& profile, const glm::dvec3& gaze) {
  std::vector<ViewportMap> maps;
  for (std::size_t v = 0; v < profile.viewports.size(); ++v) maps.push_back(viewport_map(profile, v, gaze));
  return maps;
}

inline LinearPicture picture_of(const ViewportMap& map, float value) {
  LinearPicture picture{map.width_px, map.height_px, {}};
  for (auto& plane : picture.plane) plane.assign(picture.pixels(), value);
  return picture;
}

inline std::vector<LinearPicture> pictures_of(const std::vector<ViewportMap>& maps, float value) {
  std::vector<LinearPicture> pictures;
  for (const ViewportMap& map : maps) pictures.push_back(picture_of(map, value));
  return pictures;
}

// From 0 to below 1 in steps of 2^-24.
inline float unit_value(std::mt19937& random) {
  return static_cast<float>(random() >> 8) * 0x1p-24f;
}

inline std::vector<LinearPicture> random_pictures(const std::vector<ViewportMap>& maps,
                                                  std::mt19937& random) {
  std::vector<LinearPicture> pictures = pictures_of(maps, 0);
  for (LinearPicture& picture : pictures) {
    for (auto& plane : picture.plane) {
      for (float& value : plane) value = unit_value(random);
    }
  }
  return pictures;
}

}  // namespace herr::test
