#include "renderer/probes/probe_placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/probes/probe_distances.h"

namespace herr {
namespace {

constexpr double kFarthestMove = 0.45;  // of the spacing
constexpr double kClearance = 0.1;      // of the smallest spacing: what a probe must have around it
constexpr int kClearanceRays = 64;
// A probe in a surface looks for its place from a little beside it: from within, rounding decides which side
// it sees. Shares of the smallest spacing, none of which walls are likely to share.
const glm::dvec3 kBeside{3.1e-3, 4.3e-3, 2.3e-3};
constexpr double kInSurface = 7e-3;  // from beside; kBeside is 5.8e-3 long

// Moves to try, of the spacing, the shortest first.
std::vector<glm::dvec3> moves() {
  constexpr std::array<double, 5> kSteps{-kFarthestMove, -0.5 * kFarthestMove, 0.0, 0.5 * kFarthestMove,
                                         kFarthestMove};
  std::vector<glm::dvec3> all;
  for (const double x : kSteps) {
    for (const double y : kSteps) {
      for (const double z : kSteps) {
        if (x != 0 || y != 0 || z != 0) all.push_back({x, y, z});
      }
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return glm::dot(a, a) < glm::dot(b, b); });
  return all;
}

std::vector<glm::vec3> clearance_directions() {
  std::vector<glm::vec3> all;
  for (int i = 0; i < kClearanceRays; ++i) all.emplace_back(fibonacci_direction(i, kClearanceRays));
  return all;
}

const std::vector<glm::vec3>& clearance_rays() {
  static const std::vector<glm::vec3> around = clearance_directions();
  return around;
}

}  // namespace

const std::vector<float>& ProbeSurveyor::all_around(const glm::dvec3& place, unsigned mask) {
  if (mask == kAllMask && seen_from_ == place) return fine_;
  trace_distances(scene_, lower_ + place, mask, distance_directions(), fine_);
  seen_from_.reset();
  if (mask == kAllMask) seen_from_ = place;
  return fine_;
}

double ProbeSurveyor::nearest(const glm::dvec3& place) {
  trace_distances(scene_, lower_ + place, kAllMask, clearance_rays(), few_);
  return double{*std::min_element(few_.begin(), few_.end())};
}

bool ProbeSurveyor::has_room(const glm::dvec3& place) {
  return nearest(place) >= clearance_m_;
}

bool ProbeSurveyor::sees(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::vec3 direction(glm::normalize(to - from));
  trace_distances(scene_, lower_ + from, kAllMask, std::span(&direction, 1), few_);
  return few_.front() > glm::distance(from, to);
}

// The nearest place with room that can be reached without passing through a surface; if there is none, as
// within a thin wall, the nearest with room; none where all is tight.
std::optional<glm::dvec3> ProbeSurveyor::better_place(const glm::dvec3& place, const glm::dvec3& spacing) {
  static const std::vector<glm::dvec3> kMoves = moves();
  std::optional<glm::dvec3> behind;
  for (const glm::dvec3& move : kMoves) {
    const glm::dvec3 candidate = place + move * spacing;
    if (!has_room(candidate)) continue;
    if (sees(place, candidate)) return candidate;
    if (!behind) behind = candidate;
  }
  return behind;
}

void ProbeSurveyor::face(const EmbreeScene& geometry, const ProbeGrid& grid) {
  scene_ = geometry.top();
  lower_ = grid.lower - geometry.anchor();
  clearance_m_ = kClearance * grid.smallest_spacing();
  seen_from_.reset();
}

ProbeStanding ProbeSurveyor::standing(const ProbeGrid& grid, int probe) {
  const double smallest = grid.smallest_spacing();
  glm::dvec3 place = grid.position(grid.place(probe));
  const glm::dvec3 beside = place + smallest * kBeside;
  const bool in_surface = nearest(beside) < kInSurface * smallest;
  if (in_surface) place = beside;
  const std::vector<float>& around = all_around(place, kAllMask);
  const bool has_room_here = *std::min_element(around.begin(), around.end()) >= clearance_m_;
  if (!in_surface && has_room_here) return {place, false};
  const auto better = better_place(place, grid.spacing);
  return better ? ProbeStanding{*better, true} : ProbeStanding{place, false};
}

void ProbeSurveyor::map(const glm::dvec3& place, unsigned mask, double nearest_m, std::uint32_t* words) {
  pack_distances(all_around(place, mask), nearest_m, scratch_, words);
}

void ProbePlacement::settle(ProbeVolume& volume, const Scene& scene, const EmbreeScene& geometry,
                            RenderThreads& threads) {
  const ProbeGrid& grid = volume.grid;
  volume.near_ = probes_near_geometry(grid, scene);
  const double nearest_m = double{volume.view(0, geometry.anchor()).nearest};
  std::vector<std::uint8_t> moved(volume.near_.size());
  std::vector<ProbeSurveyor> surveyors(static_cast<std::size_t>(threads.count()));
  for (ProbeSurveyor& surveyor : surveyors) surveyor.face(geometry, grid);
  threads.run(grid.size(), [&](int probe, int worker) {
    const auto i = static_cast<std::size_t>(probe);
    if (!volume.near_[i]) return;
    ProbeSurveyor& surveyor = surveyors[static_cast<std::size_t>(worker)];
    const ProbeStanding standing = surveyor.standing(grid, probe);
    moved[i] = standing.moved ? 1 : 0;
    for (ProbeSet& set : volume.sets) {
      set.put(probe, standing.place);
      surveyor.map(standing.place, set.mask, nearest_m, &set.distances[i * DistanceNodes::kCount]);
    }
  });
  for (std::size_t i = 0; i < moved.size(); ++i) volume.relocated_[i] = moved[i] != 0;
}

}  // namespace herr
