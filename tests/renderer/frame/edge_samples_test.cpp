// Samples at edges as the mean over places of their cells: shares of coverage and of shadow against the same
// counts in double precision, what stays as it was, and that nothing but the picture decides.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "renderer/frame/renderer_impl.h"
#include "tests/renderer/busy_scene.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr int kWidth = 96, kHeight = 64;  // three by two tiles
constexpr int kPlaces = 4;

RenderSettings edge_settings(int count = kPlaces) {
  RenderSettings settings = test::small_settings();
  settings.polar_width = kWidth;
  settings.polar_height = kHeight;
  settings.edge_samples = count;
  settings.camera = false;  // texels keep the share of what lies behind
  return settings;
}
DisplayProfile wide_view() {
  return test::single_view(64, 64, 45, 45);
}

// Through (column, row) of the polar buffer of a gaze straight ahead, which are whole numbers and a half in
// the middle of its first cell.
glm::dvec3 direction_at(double column, double row, double theta_max_deg) {
  const double theta = std::expm1(column / kWidth * std::log1p(theta_max_deg)) / kDegreesPerRadian;
  const double phi = glm::two_pi<double>() * row / kHeight;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta)};
}

// The rotated grid of five: the middle, and the four points of the lattice (1, 2) / 5 around it.
constexpr double kFive[5][2] = {{0, 0}, {0.2, 0.4}, {0.4, -0.2}, {-0.4, 0.2}, {-0.2, -0.4}};

struct Shares {
  int partial = 0, wrong = 0, columns_at_borders = 0, rows_at_borders = 0;
};

// Compares what the buffer's `channel` holds with the mean of `shown` over five places of each cell. A place
// closer than rounding to where `shown` changes would have no answer: the scenes have none.
template <typename Shown>
Shares compare_shares(Renderer& renderer, const RenderedFrame& frame, std::size_t channel,
                      const Shown& shown) {
  const RadianceBuffer& buffer = renderer.internals().buffers[0];
  const std::uint16_t* texels = buffer.texels();
  Shares out;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      double sum = 0;
      for (const auto& place : kFive) {
        sum += shown(direction_at(column + 0.5 + place[0], row + 0.5 + place[1], frame.theta_max_deg[0]));
      }
      const glm::dvec3 middle = direction_at(column + 0.5, row + 0.5, frame.theta_max_deg[0]);
      // Samples outside the view are not traced.
      if (std::abs(middle.x) > -0.98 * middle.z || std::abs(middle.y) > -0.98 * middle.z) continue;
      const double expected = sum / 5;
      const double found =
          test::from_half(texels[4 * texel_index(buffer.row_stride(), column, row) + channel]);
      const bool partial = std::abs(expected - std::round(expected)) > 0.1;
      out.partial += partial ? 1 : 0;
      if (partial && (column % kTileSide == 0 || column % kTileSide == kTileSide - 1))
        ++out.columns_at_borders;
      if (partial && (row % kTileSide == 0 || row % kTileSide == kTileSide - 1)) ++out.rows_at_borders;
      if (std::abs(found - expected) <= test::half_rounding(1) + 1e-6) continue;
      if (++out.wrong > 5) continue;
      std::cout << "column " << column << ", row " << row << ": " << found << " for " << expected << "\n";
    }
  }
  return out;
}

TEST(EdgeSamplesTest, FourPlacesAndTheMiddleAreTheRotatedGrid) {
  // Of lattices of five points (i, g i) / 5 those of g = 2 and 3 have the points farthest apart, sqrt(0.2);
  // g = 1 puts them on a diagonal, sqrt(0.08).
  const std::vector<CellPlace> places = lattice_places(kPlaces);
  ASSERT_EQ(places.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(places[i].column, kFive[i == 0 ? 1 : i == 1 ? 2 : i == 2 ? 3 : 4][0], 1e-12) << i;
    EXPECT_NEAR(places[i].row, kFive[i == 0 ? 1 : i == 1 ? 2 : i == 2 ? 3 : 4][1], 1e-12) << i;
  }
  // A mean that lay beside the sample would shift the picture.
  for (int count = 2; count <= kMostEdgeSamples; count += 2) {
    double column = 0, row = 0;
    for (const CellPlace& place : lattice_places(count)) {
      EXPECT_LT(std::abs(place.column), 0.5);
      EXPECT_LT(std::abs(place.row), 0.5);
      column += place.column, row += place.row;
    }
    EXPECT_NEAR(column, 0, 1e-12) << count;
    EXPECT_NEAR(row, 0, 1e-12) << count;
  }
}

// A glowing half plane before nothing: of a cell that the edge cuts, the texel keeps the share of places that
// miss. The edge x = 0.3 at z = -2 crosses borders of tiles in both directions; the seam lies on its way.
TEST(EdgeSamplesTest, ASilhouetteIsCoveredByShares) {
  Scene scene;
  test::add(scene, test::quad({0.3f, -200, -2}, {200, 0, 0}, {0, 400, 0}), test::glowing(glm::vec3{1.0f}));
  Renderer renderer(scene, wide_view(), edge_settings(), false);
  RenderedFrame frame;
  test::render_with(renderer, scene, test::sample_from({0, 0, 0}), frame);
  const auto misses = [](const glm::dvec3& d) { return d.x * 2 / -d.z > 0.3 ? 0.0 : 1.0; };
  const Shares shares = compare_shares(renderer, frame, 3, misses);
  EXPECT_GT(shares.partial, 50);
  EXPECT_GT(shares.columns_at_borders, 1);
  EXPECT_GT(shares.rows_at_borders, 1);
  EXPECT_EQ(shares.wrong, 0) << "of " << shares.partial;
  EXPECT_GE(frame.counters.edge_samples, shares.partial);
}

// The edge lies along the rows where the buffer begins again: x > 0, y = 0.
TEST(EdgeSamplesTest, TheSeamIsNoBorder) {
  Scene scene;
  test::add(scene, test::quad({-200, 0.004f, -2}, {400, 0, 0}, {0, 200, 0}), test::glowing(glm::vec3{1.0f}));
  Renderer renderer(scene, wide_view(), edge_settings(), false);
  RenderedFrame frame;
  test::render_with(renderer, scene, test::sample_from({0, 0, 0}), frame);
  const auto misses = [](const glm::dvec3& d) { return d.y * 2 / -d.z > 0.004 ? 0.0 : 1.0; };
  const Shares shares = compare_shares(renderer, frame, 3, misses);
  EXPECT_GT(shares.rows_at_borders, 20);
  EXPECT_EQ(shares.wrong, 0) << "of " << shares.partial;
}

// A pole much thinner than samples are apart, before a wall: no sample sees it on most of its length, or one
// beside it does. Places on it count one fifth each.
TEST(EdgeSamplesTest, WhatIsThinnerThanSamplesIsNotWorse) {
  Scene scene;
  test::add(scene, test::quad({-200, -200, -8}, {400, 0, 0}, {0, 400, 0}), test::glowing(glm::vec3{0.25f}));
  test::add(scene, test::quad({0.40f, -200, -2}, {0.02f, 0, 0}, {0, 400, 0}), test::glowing(glm::vec3{1.0f}));
  const auto shown = [](const glm::dvec3& d) {
    const double x = d.x * 2 / -d.z;
    return x > 0.40 && x < 0.42 ? 1.0 : 0.25;
  };
  // Of the whole buffer: the mean error of what the pole adds, over places of a fine grid in each cell.
  double squares[2] = {}, cells = 0;
  for (int which = 0; which < 2; ++which) {
    Renderer renderer(scene, wide_view(), edge_settings(which == 0 ? 0 : kPlaces), false);
    RenderedFrame frame;
    test::render_with(renderer, scene, test::sample_from({0, 0, 0}), frame);
    const RadianceBuffer& buffer = renderer.internals().buffers[0];
    cells = 0;
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        const glm::dvec3 middle = direction_at(column + 0.5, row + 0.5, frame.theta_max_deg[0]);
        if (std::abs(middle.x) > -0.98 * middle.z || std::abs(middle.y) > -0.98 * middle.z) continue;
        double sum = 0;
        constexpr int kFine = 12;
        for (int i = 0; i < kFine * kFine; ++i) {
          sum += shown(direction_at(column + (i % kFine + 0.5) / kFine, row + (i / kFine + 0.5) / kFine,
                                    frame.theta_max_deg[0]));
        }
        const double off =
            test::from_half(buffer.texels()[4 * texel_index(buffer.row_stride(), column, row)]) -
            sum / (kFine * kFine);
        squares[which] += off * off;
        ++cells;
      }
    }
  }
  const double without = std::sqrt(squares[0] / cells), with = std::sqrt(squares[1] / cells);
  std::cout << "RMSE of a thin pole: " << without << " without, " << with << " with four further places\n";
  // The pole covers a share c of a cell, the same on average for any cell that it crosses. One place errs by
  // c where it misses and by 1 - c where it hits, which it does in the share c: c (1 - c) in the mean of
  // squares. Five places do so each on their own at worst: a fifth of it, a root of 0.45; where neighbouring
  // rows of places fall together, of two at least: 0.71.
  EXPECT_LT(with, 0.7 * without);
}

// The shadow of a half plane, from a point light, on a floor below the eye that looks down. Light and half
// plane are behind the eye.
TEST(EdgeSamplesTest, TheBorderOfAHardShadowIsCoveredByShares) {
  // Floor at y = -1. From the light (0, 3, 0), the edge (0.1, 1, .) is met at t = 2 / 4 of the way down to
  // the floor: the border lies at x = 0.1 * 4 / 2 = 0.2.
  Scene scene;
  test::add(scene, test::floor_quad(200, -1), test::matte(glm::vec3{0.8f}));
  test::add(scene, test::quad({0.1f, 1, 200}, {200, 0, 0}, {0, 0, -400}), test::matte(glm::vec3{0.5f}));
  scene.lights.push_back(test::light_at({0, 3, 0}, glm::vec3{50.0f}));
  FrameSample sample = test::looking_down({0, 0, 0});
  Renderer renderer(scene, wide_view(), edge_settings(), false);
  RenderedFrame frame;
  test::render_with(renderer, scene, sample, frame);
  EXPECT_GT(frame.counters.rays[RayKind::edge_shadow], 100);
  // Lit samples change slowly along the floor, and a further place takes the light of the nearest lit sample:
  // shares are told to within a tenth of a place. In the head's frame x stays x.
  const RadianceBuffer& buffer = renderer.internals().buffers[0];
  int partial = 0, wrong = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const glm::dvec3 middle = direction_at(column + 0.5, row + 0.5, frame.theta_max_deg[0]);
      if (std::abs(middle.x) > -0.95 * middle.z || std::abs(middle.y) > -0.95 * middle.z) continue;
      int lit = 0;
      for (const auto& place : kFive) {
        const glm::dvec3 d =
            direction_at(column + 0.5 + place[0], row + 0.5 + place[1], frame.theta_max_deg[0]);
        lit += d.x / -d.z < 0.2 ? 1 : 0;
      }
      if (lit == 0 || lit == 5) continue;
      ++partial;
      // Lambert from a point light at distance^2 = 16 + r^2 (plus the highlight of 4 %, below a tenth).
      const glm::dvec3 at{middle.x / -middle.z, -1, -middle.y / -middle.z};
      const double r2 = at.x * at.x + at.z * at.z, d2 = 16 + r2;
      const double whole = 0.8 / glm::pi<double>() * 50 * (4 / std::sqrt(d2)) / d2;
      const double found =
          test::from_half(buffer.texels()[4 * texel_index(buffer.row_stride(), column, row)]);
      if (std::abs(found / whole - lit / 5.0) < 0.1) continue;
      if (++wrong < 6)
        std::cout << column << ", " << row << ": " << found / whole * 5 << " of five for " << lit << "\n";
    }
  }
  EXPECT_GT(partial, 40);
  EXPECT_EQ(wrong, 0) << "of " << partial;
}

// What a mirror shows is in shadow or not for itself: the floor beside it has the same texels whether mirror
// rays are traced or not, and as many of its samples are edges.
TEST(EdgeSamplesTest, ShadowsThatMirrorsShowAreNotTheFloors) {
  Material mirror = test::matte(glm::vec3{1.0f});
  mirror.metallic = 1;
  mirror.mirror = 1.0f;
  Scene scene;
  test::add(scene, test::floor_quad(200, -1), test::matte(glm::vec3{0.8f}));
  test::add(scene, test::quad({0.1f, 1, 200}, {200, 0, 0}, {0, 0, -400}), test::matte(glm::vec3{0.5f}));
  test::add(scene, test::quad({-0.25f, -0.9f, 0.2f}, {0.4f, 0, 0}, {0, 0, -0.4f}), mirror);
  scene.lights.push_back(test::light_at({0, 3, 0}, glm::vec3{50.0f}));
  const FrameSample sample = test::looking_down({0, 0, 0});
  RenderSettings settings = edge_settings();
  Renderer mirrors(scene, wide_view(), settings, false);
  settings.reflections = false;
  Renderer plain(scene, wide_view(), settings, false);
  RenderedFrame with, without;
  test::render_with(mirrors, scene, sample, with);
  test::render_with(plain, scene, sample, without);
  EXPECT_GT(with.counters.rays[RayKind::mirror], 50);
  const RadianceBuffer &a = mirrors.internals().buffers[0], &b = plain.internals().buffers[0];
  int compared = 0, differing = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const glm::dvec3 d = direction_at(column + 0.5, row + 0.5, with.theta_max_deg[0]);
      // In the head's frame: x stays x, down is -z. The mirror, 0.9 below the eye, spans 0.25 / 0.9 = 0.28.
      if (std::hypot(d.x / -d.z, d.y / -d.z) < 0.4) continue;
      const std::size_t at = 4 * texel_index(a.row_stride(), column, row);
      ++compared;
      differing += std::equal(a.texels() + at, a.texels() + at + 4, b.texels() + at) ? 0 : 1;
    }
  }
  EXPECT_GT(compared, 500);
  EXPECT_EQ(differing, 0) << "of " << compared;
}

TEST(EdgeSamplesTest, SamplesAwayFromEdgesKeepTheirBits) {
  const Scene scene = test::busy_scene();
  const test::TestCamera camera = test::gradient_camera();
  FrameSample sample = test::sample_from({0.1, 0.2, 0.3}, test::gaze_deg(6, -3));
  camera.attach_to(sample);
  Renderer plain(scene, test::small_profile(), edge_settings(0), true),
      smooth(scene, test::small_profile(), edge_settings(), true);
  RenderedFrame before, after;
  test::render_with(plain, scene, sample, before);
  test::render_with(smooth, scene, sample, after);
  EXPECT_EQ(before.counters.edge_samples, 0);
  EXPECT_EQ(before.counters.rays[RayKind::edge], 0);
  EXPECT_GT(after.counters.edge_samples, 0);
  EXPECT_LT(after.counters.edge_samples, after.counters.polar_samples / 2);
  EXPECT_EQ(before.counters.rays[RayKind::primary], after.counters.rays[RayKind::primary]);
  std::int64_t changed = 0;
  for (std::size_t e = 0; e < 2; ++e) {
    const RadianceBuffer &a = plain.internals().buffers[e], &b = smooth.internals().buffers[e];
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        const std::size_t at = 4 * texel_index(a.row_stride(), column, row);
        changed += std::equal(a.texels() + at, a.texels() + at + 4, b.texels() + at) ? 0 : 1;
      }
    }
  }
  EXPECT_GT(changed, 0);
  EXPECT_LE(changed, after.counters.edge_samples);
  test::expect_finite(after);
  test::expect_times_add_up(after);
}

TEST(EdgeSamplesTest, AnyNumberOfThreadsGivesTheSameBytes) {
  const Scene scene = test::busy_scene();
  const test::TestCamera camera = test::gradient_camera();
  FrameSample sample = test::sample_from({0.1, 0.2, 0.3}, test::gaze_deg(6, -3));
  camera.attach_to(sample);
  RenderSettings settings = edge_settings();
  const RenderedFrame one = test::render(scene, test::small_profile(), settings, sample);
  for (const int threads : {2, 3}) {
    settings.threads = threads;
    const RenderedFrame other = test::render(scene, test::small_profile(), settings, sample);
    test::expect_same_bits(one, other);
    EXPECT_EQ(one.counters.edge_samples, other.counters.edge_samples);
    EXPECT_EQ(one.counters.rays[RayKind::edge], other.counters.rays[RayKind::edge]);
    EXPECT_EQ(one.counters.rays[RayKind::edge_shadow], other.counters.rays[RayKind::edge_shadow]);
  }
}

// Nothing here is random but light samples, of which there is one: a later frame of a still head is the same.
TEST(EdgeSamplesTest, AStillHeadAndGazeGiveAStillPicture) {
  const Scene scene = test::busy_scene();
  FrameSample sample = test::sample_from({0.1, 0.2, 0.3}, test::gaze_deg(6, -3));
  Renderer renderer(scene, test::small_profile(), edge_settings(), false);
  RenderedFrame first, second;
  test::render_with(renderer, scene, sample, first);
  sample.t_ns += 11'111'111;
  test::render_with(renderer, scene, sample, second);
  EXPECT_GT(first.counters.edge_samples, 0);
  test::expect_same_bits(first, second);
}

TEST(EdgeSamplesTest, ThePlanSaysWhyNoneAreTaken) {
  const Scene scene = test::busy_scene();
  const auto reason = [&](const RenderSettings& settings) {
    for (const PlanEntry& entry : plan_frame(scene, settings, false).entries) {
      if (entry.name == "edge samples") return (entry.runs ? "runs: " : "skipped: ") + entry.reason;
    }
    return std::string();
  };
  EXPECT_EQ(reason(edge_settings()), "runs: 4 further rays through each sample at an edge");
  EXPECT_EQ(reason(edge_settings(0)), "skipped: not asked for");
  RenderSettings planar = test::planar_settings();
  planar.edge_samples = 4;
  EXPECT_EQ(reason(planar), "skipped: foveation is off");
  EXPECT_EQ(plan_frame(scene, planar, false).edge_samples, 0);
}

}  // namespace
}  // namespace herr
