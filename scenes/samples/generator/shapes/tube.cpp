#include "scenes/samples/generator/shapes/tube.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/samples/generator/shapes/grid.h"

namespace herr::samples {

namespace {

struct Frame {
  glm::vec3 along{0.0f}, side{0.0f}, up{0.0f};  // right-handed: side x up = along
};

glm::vec3 tangent_at(const std::vector<TubePoint>& path, std::size_t i, bool closed) {
  const std::size_t n = path.size();
  const std::size_t before = i > 0 ? i - 1 : (closed ? n - 1 : 0);
  const std::size_t after = i + 1 < n ? i + 1 : (closed ? 0 : n - 1);
  return glm::normalize(path[after].centre - path[before].centre);
}

// The frame at `to`, from that at `from` by two reflections: no rotation about the curve.
Frame carried(const Frame& frame, const glm::vec3& from, const glm::vec3& to, const glm::vec3& tangent) {
  const glm::vec3 chord = to - from;
  const float chord2 = glm::dot(chord, chord);
  glm::vec3 side = frame.side, along = frame.along;
  if (chord2 > 0.0f) {
    side -= 2.0f / chord2 * glm::dot(chord, side) * chord;
    along -= 2.0f / chord2 * glm::dot(chord, along) * chord;
  }
  const glm::vec3 bend = tangent - along;
  const float bend2 = glm::dot(bend, bend);
  if (bend2 > 0.0f) side -= 2.0f / bend2 * glm::dot(bend, side) * bend;
  side = glm::normalize(side - glm::dot(side, tangent) * tangent);
  return {tangent, side, glm::cross(tangent, side)};
}

std::vector<Frame> frames_along(const std::vector<TubePoint>& path, bool closed) {
  const glm::vec3 start = tangent_at(path, 0, closed);
  const glm::vec3 reference = std::abs(start.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::vec3 side = glm::normalize(glm::cross(reference, start));
  std::vector<Frame> frames{{start, side, glm::cross(start, side)}};
  for (std::size_t i = 1; i < path.size(); ++i) {
    frames.push_back(carried(frames.back(), path[i - 1].centre, path[i].centre, tangent_at(path, i, closed)));
  }
  if (!closed) return frames;
  // Spread the angle that is left after one round over the whole curve.
  const Frame end = carried(frames.back(), path.back().centre, path[0].centre, start);
  const float twist = std::atan2(glm::dot(end.side, frames[0].up), glm::dot(end.side, frames[0].side));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const float angle = -twist * static_cast<float>(i) / static_cast<float>(frames.size());
    const Frame f = frames[i];
    frames[i].side = std::cos(angle) * f.side + std::sin(angle) * f.up;
    frames[i].up = std::cos(angle) * f.up - std::sin(angle) * f.side;
  }
  return frames;
}

void add_disc(Mesh& mesh, const TubePoint& point, const Frame& frame, const TubeOptions& options,
              float outwards) {
  const glm::vec3 normal = outwards * frame.along;
  const std::uint32_t centre = add_vertex(mesh, {point.centre, normal, {0.5f, 0.5f}});
  for (int j = 0; j <= options.sides; ++j) {
    const float angle = 2.0f * kPi * static_cast<float>(j) / static_cast<float>(options.sides);
    const glm::vec2 round = options.flatten * glm::vec2(std::cos(angle), std::sin(angle));
    const glm::vec3 at = point.centre + point.radius_m * (round.x * frame.side + round.y * frame.up);
    const std::uint32_t rim = add_vertex(mesh, {at, normal, glm::vec2(0.5f) + 0.5f * round});
    if (j == 0) continue;
    if (outwards > 0.0f) {
      add_triangle(mesh, centre, rim - 1, rim);
    } else {
      add_triangle(mesh, centre, rim, rim - 1);
    }
  }
}

}  // namespace

Mesh tube(const std::vector<TubePoint>& path, const TubeOptions& options) {
  const std::vector<Frame> frames = frames_along(path, options.closed);
  const int spans = static_cast<int>(path.size()) - (options.closed ? 0 : 1);
  Mesh mesh = grid_mesh(options.sides, spans, [&](float u, float v) {
    const auto i = static_cast<std::size_t>(std::lround(v * static_cast<float>(spans))) % path.size();
    const float angle = 2.0f * kPi * u;
    const float c = std::cos(angle), s = std::sin(angle);
    const Frame& f = frames[i];
    const glm::vec3 arm = options.flatten.x * c * f.side + options.flatten.y * s * f.up;
    const glm::vec3 normal = c / options.flatten.x * f.side + s / options.flatten.y * f.up;
    return Vertex{path[i].centre + path[i].radius_m * arm, glm::normalize(normal), {u, v}};
  });
  if (!options.closed) {
    add_disc(mesh, path.front(), frames.front(), options, -1.0f);
    add_disc(mesh, path.back(), frames.back(), options, 1.0f);
  }
  return mesh;
}

}  // namespace herr::samples
