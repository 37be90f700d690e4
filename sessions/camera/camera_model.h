// Camera intrinsics: how a direction in camera space maps to a pixel and back.
// Camera space here is the world's convention: looks along -Z, +Y up, +X right; pixel (0,0) is the centre of
// the upper-left pixel, x to the right, y down. (Files of OpenCV-style tools flip y and z on import.)
// Sources: Brown-Conrady and KB4 (Kannala & Brandt 2006) as in OpenCV; Fisheye624 as in Project Aria.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace herr {

enum class CameraModelKind { pinhole, kb4, fisheye624 };

struct CameraModel {
  CameraModelKind kind = CameraModelKind::pinhole;
  int width_px = 0, height_px = 0;        // size of every image of the stream
  double fx = 0, fy = 0, cx = 0, cy = 0;  // pixels
  // pinhole: k1 k2 p1 p2 k3 (Brown-Conrady); kb4: k1..k4; fisheye624: k0..k5 p0 p1 s0..s3.
  std::array<double, 12> distortion{};
  double max_angle_rad = 0;  // beyond this angle from the axis the model is not valid (set by prepare())

  // Finds max_angle_rad: the largest angle up to which the radial distortion is monotonic.
  // Call once after parsing.
  void prepare();
  // Pixel of a direction (any length), or none when it lies beyond max_angle_rad. Thread-safe.
  std::optional<glm::dvec2> project(const glm::dvec3& direction) const;
  // Unit direction of a pixel; Newton's iteration on the model. None when it does not converge. Thread-safe.
  std::optional<glm::dvec3> unproject(const glm::dvec2& pixel) const;
  // True when the pixel lies within the image.
  bool contains(const glm::dvec2& pixel) const {
    return pixel.x >= -0.5 && pixel.y >= -0.5 && pixel.x <= width_px - 0.5 && pixel.y <= height_px - 0.5;
  }
};

// A pinhole camera without distortion whose width spans `hfov_deg`, in (0, 180), with its axis in the middle.
CameraModel pinhole_camera(int width_px, int height_px, double hfov_deg);

}  // namespace herr
