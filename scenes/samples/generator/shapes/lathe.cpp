#include "scenes/samples/generator/shapes/lathe.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/samples/generator/shapes/grid.h"

namespace herr::samples {

namespace {

struct CurvePoint {
  glm::vec2 at;       // radius, height
  glm::vec2 tangent;  // unit
  float length = 0.0f;
};

glm::vec2 coordinates(const ProfilePoint& p) {
  return {p.radius_m, p.height_m};
}

// Catmull-Rom over points first ... last of the profile, the ends doubled.
std::vector<CurvePoint> smooth_run(const std::vector<ProfilePoint>& profile, std::size_t first,
                                   std::size_t last, int steps) {
  const auto point = [&](std::size_t index, int offset) {
    const auto wanted = static_cast<std::ptrdiff_t>(index) + offset;
    return coordinates(profile[static_cast<std::size_t>(
        std::clamp(wanted, static_cast<std::ptrdiff_t>(first), static_cast<std::ptrdiff_t>(last)))]);
  };
  std::vector<CurvePoint> run;
  for (std::size_t span = first; span < last; ++span) {
    const glm::vec2 a = point(span, -1), b = point(span, 0), c = point(span, 1), d = point(span, 2);
    for (int i = span == first ? 0 : 1; i <= steps; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(steps);
      glm::vec2 at =
          b +
          0.5f * t * ((c - a) + t * ((2.0f * a - 5.0f * b + 4.0f * c - d) + t * (3.0f * (b - c) + d - a)));
      at.x = std::max(at.x, 0.0f);  // the curve may overshoot the axis
      glm::vec2 tangent =
          0.5f *
          ((c - a) + t * (2.0f * (2.0f * a - 5.0f * b + 4.0f * c - d) + 3.0f * t * (3.0f * (b - c) + d - a)));
      if (glm::length(tangent) < 1e-9f) tangent = c - b;
      run.push_back({at, glm::normalize(tangent)});
    }
  }
  return run;
}

void add_run(Mesh& mesh, const std::vector<CurvePoint>& run, int slices) {
  const int rows = static_cast<int>(run.size()) - 1;
  append(mesh,
         grid_mesh(rows, slices,
                   [&](float u, float v) {
                     const CurvePoint& p =
                         run[static_cast<std::size_t>(std::lround(u * static_cast<float>(rows)))];
                     const float angle = 2.0f * kPi * v;
                     const float x = std::cos(angle), z = std::sin(angle);
                     return Vertex{{p.at.x * x, p.at.y, p.at.x * z},
                                   {p.tangent.y * x, -p.tangent.x, p.tangent.y * z},
                                   {v, p.length}};
                   }),
         glm::mat4(1.0f));
}

}  // namespace

Mesh lathe(const std::vector<ProfilePoint>& profile, const LatheOptions& options) {
  // Cut the profile at its sharp points: each run has normals of its own.
  std::vector<std::vector<CurvePoint>> runs;
  std::size_t first = 0;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    if (!profile[i].sharp && i + 1 < profile.size()) continue;
    runs.push_back(smooth_run(profile, first, i, options.steps_per_span));
    first = i;
  }
  // Texture runs by length over the whole profile.
  float length = 0.0f;
  for (auto& run : runs) {
    for (std::size_t i = 0; i < run.size(); ++i) {
      if (i > 0) length += glm::distance(run[i].at, run[i - 1].at);
      run[i].length = length;
    }
  }
  Mesh mesh;
  for (auto& run : runs) {
    for (CurvePoint& p : run) p.length = 1.0f - p.length / length;
    add_run(mesh, run, options.slices);
  }
  return mesh;
}

}  // namespace herr::samples
