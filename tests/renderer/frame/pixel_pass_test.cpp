// Passes over single pixels and tiles: where their rays go, what their mean is, and what they leave alone.
#include "renderer/pixel_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <vector>

#include "renderer/frame/renderer_impl.h"
#include "tests/renderer/busy_scene.h"
#include "tests/renderer/penumbra_scene.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

using Place = std::array<double, 2>;

constexpr int kSide = 16;  // pixels of a picture whose borders are tangents -1 and 1

DisplayProfile square_view() {
  return test::single_view(kSide, kSide, 45, 45);
}

SceneState start_of(const Scene& scene) {
  SceneState state;
  scene_state_at(scene, 0, state);
  return state;
}

PixelPass jittered(int index, std::uint32_t sequence = 0) {
  PixelPass pass;
  pass.jitter = true;
  pass.index = index;
  pass.sequence = sequence;
  return pass;
}

// Where in its pixel the ray of each pixel of a pass went, from the rays themselves: row by row.
std::vector<Place> places_of(Renderer& renderer, const SceneState& state, const PixelPass& pass) {
  RenderedFrame frame;
  renderer.render_pass(test::sample_from({0, 0, 0}), state, pass, frame);
  RayRecorder recorder;
  renderer.internals().run_tile(0, 0, &recorder);
  const RecordedRays rays = recorder.rays[static_cast<std::size_t>(RayKind::primary)].dense();
  std::vector<Place> places(kSide * kSide, Place{-1, -1});
  EXPECT_EQ(rays.size(), places.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double x = (double{rays.dx[i]} / -double{rays.dz[i]} + 1) / 2 * kSide,
                 y = (1 - double{rays.dy[i]} / -double{rays.dz[i]}) / 2 * kSide;
    // A place at a border may be rounded to the other side.
    const int column = std::clamp(static_cast<int>(x), 0, kSide - 1),
              row = std::clamp(static_cast<int>(y), 0, kSide - 1);
    places[static_cast<std::size_t>(row * kSide + column)] = {x - column, y - row};
  }
  return places;
}

double fraction(double x) {
  return x - std::floor(x);
}

// How far the mean over the first `count` places of the R2 sequence may lie from the integral, at worst over
// all shifts: of x, of y and of x y. A mean is linear in each shift between those where a place passes the
// border, so it is enough to look on both sides of these.
std::array<double, 3> worst_means(int count) {
  double g = 1.3;
  for (int i = 0; i < 50; ++i) g -= (g * g * g - g - 1) / (3 * g * g - 1);  // Newton
  std::vector<double> borders[2];
  for (int axis = 0; axis < 2; ++axis) {
    const double step = axis == 0 ? 1 / g : 1 / (g * g);
    for (int i = 0; i < count; ++i) borders[axis].push_back(fraction(-step * i));
  }
  std::array<double, 3> worst{};
  for (const double at_x : borders[0]) {
    for (const double at_y : borders[1]) {
      for (const double side : {-1e-9, 1e-9}) {
        for (const double other : {-1e-9, 1e-9}) {
          double x_sum = 0, y_sum = 0, xy_sum = 0;
          for (int i = 0; i < count; ++i) {
            const double x = fraction(at_x + side + i / g), y = fraction(at_y + other + i / (g * g));
            x_sum += x, y_sum += y, xy_sum += x * y;
          }
          worst[0] = std::max(worst[0], std::abs(x_sum / count - 0.5));
          worst[1] = std::max(worst[1], std::abs(y_sum / count - 0.5));
          worst[2] = std::max(worst[2], std::abs(xy_sum / count - 0.25));
        }
      }
    }
  }
  return worst;
}

TEST(PixelPassTest, PlacesFillEachPixelEvenly) {
  constexpr int kPasses = 64;
  Scene scene;
  test::add(scene, test::floor_quad(1), test::matte(glm::vec3{0.5f}));
  const SceneState state = start_of(scene);
  Renderer renderer(scene, square_view(), test::planar_settings(), false);
  std::vector<std::array<double, 3>> sums(kSide * kSide);
  std::vector<Place> first, second;
  // Directions are unit vectors of floats, 1e-7 each; a pixel is 1/8 wide.
  constexpr double kRounding = 4e-6;
  for (int index = 0; index < kPasses; ++index) {
    const std::vector<Place> places = places_of(renderer, state, jittered(index));
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (const double at : places[i]) {
        ASSERT_GE(at, -kRounding);
        ASSERT_LT(at, 1 + kRounding);
      }
      sums[i][0] += places[i][0], sums[i][1] += places[i][1], sums[i][2] += places[i][0] * places[i][1];
    }
    if (index == 0) first = places;
    if (index == 1) second = places;
  }
  const std::array<double, 3> worst = worst_means(kPasses);
  std::cout << "means of 64 places lie off by at most " << worst[0] << ", " << worst[1] << " and " << worst[2]
            << "; of independent ones by 0.036 (one deviation)\n";
  double squares = 0;
  for (const auto& sum : sums) {
    squares += (sum[0] / kPasses - 0.5) * (sum[0] / kPasses - 0.5);
    EXPECT_NEAR(sum[0] / kPasses, 0.5, worst[0] + kRounding);
    EXPECT_NEAR(sum[1] / kPasses, 0.5, worst[1] + kRounding);
    EXPECT_NEAR(sum[2] / kPasses, 0.25, worst[2] + kRounding);
  }
  // Half of what independent places would have.
  std::cout << "RMS over pixels: " << std::sqrt(squares / (kSide * kSide)) << "\n";
  EXPECT_LT(std::sqrt(squares / (kSide * kSide)), 0.018);
  // From pixel to pixel places are independent: the mean of 256 has a deviation of 0.289 / 16 = 0.018, their
  // square's mean 1/3 one of 0.298 / 16.
  for (std::size_t axis = 0; axis < 2; ++axis) {
    double mean = 0, square = 0;
    for (const Place& place : first) mean += place[axis], square += place[axis] * place[axis];
    EXPECT_NEAR(mean / 256, 0.5, 4 * 0.018);
    EXPECT_NEAR(square / 256, 1.0 / 3, 4 * 0.0186);
  }
  EXPECT_NE(first, second);
  EXPECT_NE(first, places_of(renderer, state, jittered(0, 1))) << "another sequence";
  PixelPass other_seed = jittered(0);
  other_seed.seed = 99;
  EXPECT_EQ(first, places_of(renderer, state, other_seed)) << "light's numbers are none of the rays'";
  for (const Place& place : places_of(renderer, state, {})) {
    EXPECT_NEAR(place[0], 0.5, kRounding);
    EXPECT_NEAR(place[1], 0.5, kRounding);
  }
}

// Area of the square [0, 1]^2 where a x + b y < c: the square cut by the line, by the sum of the cut
// polygon's corners.
double area_below(double a, double b, double c) {
  const std::array<Place, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  std::vector<Place> cut;
  for (std::size_t i = 0; i < 4; ++i) {
    const Place &p = square[i], &q = square[(i + 1) % 4];
    const double at_p = a * p[0] + b * p[1] - c, at_q = a * q[0] + b * q[1] - c;
    if (at_p < 0) cut.push_back(p);
    if ((at_p < 0) == (at_q < 0)) continue;
    const double t = at_p / (at_p - at_q);
    cut.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
  }
  double twice = 0;
  for (std::size_t i = 0; i < cut.size(); ++i) {
    const Place &p = cut[i], &q = cut[(i + 1) % cut.size()];
    twice += p[0] * q[1] - q[0] * p[1];
  }
  return twice / 2;
}

// White where x + 0.4 y < 0.07 on the plane z = -1, black beyond: a white metal under ambient 1 is exactly 1,
// and pixels that see nothing are 0.
Scene slanted_edge() {
  Scene scene;
  const glm::vec3 along{-0.4f, 1, 0};
  Material white = test::matte(glm::vec3{1.0f});
  white.metallic = 1;
  test::add(scene, test::quad(glm::vec3{0.07f, 0, -1} - 3.0f * along, 6.0f * along, {-6, 0, 0}), white);
  scene.ambient = glm::vec3{1.0f};
  return scene;
}

TEST(PixelPassTest, TheMeanOverAnEdgeIsTheAreaThatItCovers) {
  constexpr int kPasses = 256;
  const Scene scene = slanted_edge();
  const SceneState state = start_of(scene);
  Renderer renderer(scene, square_view(), test::planar_settings(), false);
  std::vector<double> sum(kSide * kSide);
  RenderedFrame frame;
  for (int index = 0; index < kPasses; ++index) {
    renderer.render_pass(test::sample_from({0, 0, 0}), state, jittered(index), frame);
    std::size_t i = 0;
    test::for_each_pixel(frame.viewports[0], [&](int, int, const test::Pixel& p) { sum[i++] += p[1]; });
  }
  double squares = 0, independent = 0, bias = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      // Pixel (x, y) spans [-1 + x/8, ...] to the right and [1 - y/8, ...] downwards: the edge in its
      // coordinates.
      const double px = 2.0 / kSide;
      const double area = area_below(px, -0.4 * px, 0.07 + 1 - px * x - 0.4 * (1 - px * y));
      const double off = sum[static_cast<std::size_t>(y * kSide + x)] / kPasses - area;
      const double deviation2 = area * (1 - area) / kPasses;  // of independent places
      EXPECT_LE(std::abs(off), 4 * std::sqrt(deviation2) + 1e-9) << x << ", " << y;
      squares += off * off, independent += deviation2, bias += off;
    }
  }
  std::cout << "RMS error over that of independent places: " << std::sqrt(squares / independent) << "\n";
  // Each place alone is uniform, so the mean over pixels shows no bias beyond four deviations; and places
  // that fill the pixel evenly do better than independent ones by far: a strip of the pixel along the edge as
  // wide as the places' spacing, 1/16, decides, a coin for each of 16 places there: 4 / 256 of the area
  // against 8 / 256.
  EXPECT_GT(independent, 0.01 / kPasses);
  EXPECT_LE(std::abs(bias), 4 * std::sqrt(independent));
  EXPECT_LE(std::sqrt(squares / independent), 0.5);
}

// 4 samples of a light of 1 m: every pixel of the penumbra is noise.
TEST(PixelPassTest, OtherSeedsAreOtherNoiseAroundTheSameMean) {
  constexpr int kPasses = 64;
  const Scene scene = test::edge_scene({1, 0, 1});
  const SceneState state = start_of(scene);
  RenderSettings settings = test::planar_settings();
  settings.light_samples = 4;
  Renderer renderer(scene, test::penumbra_view(48, 12), settings, false);
  const std::size_t pixels = 48 * 12;
  std::vector<double> sum[2], squares(pixels);
  RenderedFrame frame, first;
  for (std::uint32_t set = 0; set < 2; ++set) {
    sum[set].resize(pixels);
    for (std::uint32_t i = 0; i < kPasses; ++i) {
      PixelPass pass;
      pass.seed = kPasses * set + i;
      renderer.render_pass(test::penumbra_sample(), state, pass, frame);
      if (pass.seed == 0) first = frame;
      EXPECT_EQ(test::same_bits(first.viewports[0], frame.viewports[0]), pass.seed == 0) << pass.seed;
      std::size_t at = 0;
      test::for_each_pixel(frame.viewports[0], [&](int, int, const test::Pixel& p) {
        sum[set][at] += p[0], squares[at++] += p[0] * p[0];
      });
    }
  }
  double between = 0, within = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const double mean = (sum[0][i] + sum[1][i]) / (2 * kPasses);
    const double variance = (squares[i] / (2 * kPasses) - mean * mean) * 2 * kPasses / (2 * kPasses - 1);
    const double difference = (sum[0][i] - sum[1][i]) / kPasses;
    between += difference * difference, within += 2 * variance / kPasses;
  }
  // The difference of two means of 64 has twice the variance of one pass over 64. Some 480 pixels lie in the
  // penumbra: their mean square is known to sqrt(2 / 480) = 6.5 %; four of these.
  std::cout << "means of 64 seeds differ by " << std::sqrt(between / within) << " of what chance makes\n";
  EXPECT_GT(within, 0);
  EXPECT_NEAR(between / within, 1, 0.26);
}

TEST(PixelPassTest, APassWithTheSettingsSeedAndNothingElseIsTheFrame) {
  const Scene scene = test::busy_scene();
  const SceneState state = start_of(scene);
  const FrameSample sample = test::sample_from({0, 0, 0});
  for (RenderSettings settings : {test::planar_settings(), test::small_settings()}) {
    settings.light_samples = 4;
    settings.seed = 7;
    Renderer renderer(scene, test::small_profile(), settings, false);
    RenderedFrame frame, pass;
    renderer.render_frame(sample, state, frame);
    PixelPass same;
    same.seed = 7;
    renderer.render_pass(sample, state, same, pass);
    test::expect_same_bits(frame, pass);
    same.seed = 8;
    renderer.render_pass(sample, state, same, pass);
    EXPECT_FALSE(test::same_bits(frame.viewports[0], pass.viewports[0]));
  }
}

TEST(PixelPassTest, TilesHoldEveryPixelOnce) {
  const Scene scene = slanted_edge();
  const DisplayProfile profile = test::small_profile(70, 33, 64);
  Renderer renderer(scene, profile, test::planar_settings(), false);
  std::vector<std::vector<int>> held;
  for (const Viewport& v : profile.viewports)
    held.emplace_back(static_cast<std::size_t>(v.width_px * v.height_px));
  for (const PixelTile& tile : renderer.pixel_tiles()) {
    const auto v = static_cast<std::size_t>(tile.viewport);
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x)
        ++held.at(v).at(static_cast<std::size_t>(y * profile.viewports[v].width_px + x));
    }
  }
  for (const std::vector<int>& counts : held) {
    EXPECT_EQ(std::count(counts.begin(), counts.end(), 1), static_cast<std::int64_t>(counts.size()));
  }
  EXPECT_TRUE(Renderer(scene, profile, test::small_settings(), false).pixel_tiles().empty());
}

bool same_bits_in(const PixelTile& tile, const RenderedFrame& a, const RenderedFrame& b) {
  const auto v = static_cast<std::size_t>(tile.viewport);
  for (int y = tile.y0; y < tile.y1; ++y) {
    const std::uint16_t* row = a.viewports[v].row(y);
    if (!std::equal(row + 4 * tile.x0, row + 4 * tile.x1, b.viewports[v].row(y) + 4 * tile.x0)) return false;
  }
  return true;
}

TEST(PixelPassTest, OnlyTheTilesAskedForChangeAtAnyNumberOfThreads) {
  const Scene scene = test::busy_scene();
  const SceneState state = start_of(scene);
  const FrameSample sample = test::sample_from({0, 0, 0});
  RenderSettings settings = test::planar_settings();
  settings.light_samples = 4;
  RenderedFrame whole, part_of_one;
  for (const int threads : {1, 2, 5}) {
    settings.threads = threads;
    Renderer renderer(scene, test::small_profile(70, 80, 48), settings, false);
    RenderedFrame before, part;
    renderer.render_frame(sample, state, before);
    const std::vector<PixelTile> tiles = renderer.pixel_tiles();
    std::vector<std::uint8_t> wanted(tiles.size());
    PixelPass pass = jittered(3, 1);
    pass.seed = 21;
    std::int64_t rays = 0;
    for (std::size_t i = 0; i < tiles.size(); i += 3) {
      wanted[i] = 1;
      rays += (tiles[i].x1 - tiles[i].x0) * (tiles[i].y1 - tiles[i].y0);
    }
    pass.tiles = wanted;
    renderer.render_pass(sample, state, pass, part);
    EXPECT_EQ(part.counters.rays[RayKind::primary], rays);
    pass.tiles = {};
    Renderer other(scene, test::small_profile(70, 80, 48), settings, false);
    other.render_pass(sample, state, pass, whole);
    std::array<int, 2> differing{};
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      EXPECT_TRUE(same_bits_in(tiles[i], part, wanted[i] ? whole : before)) << "tile " << i;
      differing[wanted[i]] += same_bits_in(tiles[i], whole, before) ? 0 : 1;
    }
    // Of 26 tiles, those that see the sky alone show nothing.
    EXPECT_GE(differing[0], 6);
    EXPECT_GE(differing[1], 3);
    if (threads == 1) part_of_one = part;
    test::expect_same_bits(part_of_one, part);
  }
}

TEST(PixelPassTest, WhatCannotBeIsRefused) {
  const Scene scene = slanted_edge();
  const SceneState state = start_of(scene);
  const FrameSample sample = test::sample_from({0, 0, 0});
  RenderedFrame frame;
  Renderer foveated(scene, square_view(), test::small_settings(), false);
  EXPECT_THROW(foveated.render_pass(sample, state, jittered(0), frame), std::invalid_argument);
  PixelPass tiled;
  const std::vector<std::uint8_t> none(4), one(1, 1);
  tiled.tiles = one;
  EXPECT_THROW(foveated.render_pass(sample, state, tiled, frame), std::invalid_argument);
  RenderSettings settings = test::planar_settings();
  Renderer planar(scene, square_view(), settings, false);
  planar.render_pass(sample, state, tiled, frame);
  tiled.tiles = none;
  EXPECT_THROW(planar.render_pass(sample, state, tiled, frame), std::invalid_argument);
  settings.scale = 0.5;
  Renderer scaled(scene, square_view(), settings, false);
  tiled.tiles = one;
  EXPECT_THROW(scaled.render_pass(sample, state, tiled, frame), std::invalid_argument);
  EXPECT_THROW(scaled.render_pass(sample, state, jittered(0), frame), std::invalid_argument);
  scaled.render_pass(sample, state, {}, frame);
}

}  // namespace
}  // namespace herr
