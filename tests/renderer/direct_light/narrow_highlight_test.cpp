// Highlights of a box lamp on smooth metal, narrower than the lamp's strata, against the integral over
// directions in double: the GGX lobe times what the lamp has along each direction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "tests/renderer/direct_light/scalar_light.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr double kEyeHeight_m = 1.0, kScreenHeight_m = 0.5;

// A floor of metal that is as white as can be; the eye is 1 m above it and looks at where it sees the lamp's
// edge and a corner.
struct MirroredLamp {
  Scene scene;
  DisplayProfile profile;
  double alpha;
  bool screened;  // a dark screen half a metre above the floor hides x < 0 of what is above

  MirroredLamp(double alpha_, const glm::vec3& size, double half_deg, bool screened_ = false)
      : profile(test::single_view(16, 16, half_deg, half_deg)), alpha(alpha_), screened(screened_) {
    Material metal = test::matte(glm::vec3{1.0f});
    metal.metallic = 1;
    metal.roughness = static_cast<float>(std::sqrt(alpha));
    test::add(scene, test::floor_quad(10), metal);
    if (screened) {
      test::add(scene, test::quad({-5, kScreenHeight_m, 5}, {5, 0, 0}, {0, 0, -10}),
                test::matte(glm::vec3{0.0f}));
    }
    scene.lights = {test::light_at({0.17, 1.4, 0.15}, glm::vec3{2.0f}, size)};
  }

  RenderedFrame render(int samples, std::uint32_t seed, int first_samples = 0) const {
    RenderSettings settings = test::planar_settings();
    settings.light_samples = samples;
    settings.adaptive_min_samples = first_samples;
    settings.seed = seed;
    return test::render(scene, profile, settings, test::looking_down({0, eye_m(), 0}));
  }

  // Below the screen, where there is one.
  double eye_m() const { return screened ? 0.45 : kEyeHeight_m; }

  // Integral of t^2 / max(t^2, r^2) over what a ray from `p` has of the lamp, over its volume; of a plate
  // that lies level, as the limit of thin ones: t^2 / max(t^2, r^2) / (cosine x area).
  double lamp_along(const glm::dvec3& p, const glm::dvec3& direction) const {
    const AreaLight& lamp = scene.lights[0];
    const glm::dvec3 half = 0.5 * glm::dvec3(lamp.size);
    const double r = std::max({half.x, half.y, half.z});
    if (half.y == 0) {
      const double t = (lamp.centre.y - p.y) / direction.y;
      const glm::dvec3 off = glm::abs(p + t * direction - lamp.centre);
      if (off.x > half.x || off.z > half.z) return 0;
      return t * t / std::max(t * t, r * r) / (direction.y * 4 * half.x * half.z);
    }
    double begin = 0, end = 1e300;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (lamp.centre[axis] - half[axis] - p[axis]) / direction[axis];
      const double b = (lamp.centre[axis] + half[axis] - p[axis]) / direction[axis];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    if (end <= begin) return 0;
    const double inner = std::clamp(r, begin, end);  // below it t^2 / r^2
    const double integral = (inner * inner * inner - begin * begin * begin) / (3 * r * r) + (end - inner);
    return integral / (8 * half.x * half.y * half.z);
  }

  // Radiance of the floor at `p`: over half vectors as GGX has them, D n.h per steradian, by midpoints.
  double radiance(const glm::dvec3& p, const glm::dvec3& viewer) const {
    constexpr int kRings = 128, kSectors = 128;
    const test::SurfacePoint at{p, {0, 1, 0}, viewer};
    double sum = 0;
    for (int i = 0; i < kRings; ++i) {
      const double u = (i + 0.5) / kRings, tan2 = alpha * alpha * u / (1 - u);
      const double cosine = 1 / std::sqrt(1 + tan2), sine = std::sqrt(tan2) * cosine;
      const double root = cosine * cosine * (alpha * alpha - 1) + 1;
      const double per_steradian = alpha * alpha / (glm::pi<double>() * root * root) * cosine;
      for (int j = 0; j < kSectors; ++j) {
        const double azimuth = glm::two_pi<double>() * (j + 0.5) / kSectors;
        const glm::dvec3 h{sine * std::cos(azimuth), cosine, sine * std::sin(azimuth)};
        const double v_h = glm::dot(viewer, h);
        const glm::dvec3 l = 2 * v_h * h - viewer;
        if (l.y <= 0 || v_h <= 0) continue;
        // Through the screen's edge plane: hidden where it crosses the screen's height left of it.
        if (screened && p.x + l.x / l.y * kScreenHeight_m < 0) continue;
        const double lamp = lamp_along(p, l);
        if (lamp > 0) sum += test::brdf(scene.materials[0], at, l).x * l.y * lamp * 4 * v_h / per_steradian;
      }
    }
    return scene.lights[0].intensity_w_sr.x * sum / (kRings * kSectors);
  }

  std::vector<double> exact() const {
    std::vector<double> all;
    const Viewport& view = profile.viewports[0];
    for (int y = 0; y < view.height_px; ++y) {
      for (int x = 0; x < view.width_px; ++x) {
        const glm::dvec3 d = test::direction_of_pixel(view, x, y);
        const glm::dvec3 world{d.x, d.z, -d.y};
        all.push_back(radiance(glm::dvec3{0, eye_m(), 0} + (eye_m() / -world.y) * world, -world));
      }
    }
    return all;
  }
};

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

// Of several seeds: the mean picture over the exact one's mean, its standard error, the RMS error of one
// picture over that mean, and the brightest pixel over the brightest exact one.
struct Error {
  double mean = 0, standard_error = 0, rms = 0, brightest = 0;
};

Error error_of(const MirroredLamp& lamp, const std::vector<double>& exact, int samples, int seeds,
               int first_samples = 0) {
  const double scale = mean_of(exact);
  std::vector<double> means;
  Error error;
  double squares = 0, most = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const RenderedFrame frame = lamp.render(samples, static_cast<std::uint32_t>(seed), first_samples);
    std::vector<double> seen;
    test::for_each_pixel(frame.viewports[0],
                         [&](int, int, const test::Pixel& pixel) { seen.push_back(pixel[0]); });
    means.push_back(mean_of(seen) / scale);
    for (std::size_t i = 0; i < seen.size(); ++i) squares += (seen[i] - exact[i]) * (seen[i] - exact[i]);
    most = std::max(most, *std::max_element(seen.begin(), seen.end()));
  }
  error.mean = mean_of(means);
  for (const double m : means) error.standard_error += (m - error.mean) * (m - error.mean);
  error.standard_error = std::sqrt(error.standard_error / (seeds - 1) / seeds);
  error.rms = std::sqrt(squares / (seeds * static_cast<double>(exact.size()))) / scale;
  error.brightest = most / *std::max_element(exact.begin(), exact.end());
  return error;
}

// Views as wide as no ray widens the lobe: 5 (spread / 2)^2 < alpha^2 / 2 leaves alpha > 1.6 spreads.
struct Case {
  double alpha, half_deg;
};
constexpr Case kCases[] = {{0.003, 0.8}, {0.012, 3}, {0.05, 12}};

TEST(NarrowHighlightTest, IsTheIntegralOverTheLampForAnyNumberOfSamples) {
  for (const Case& at : kCases) {
    for (const glm::vec3& size : {glm::vec3{0.4f, 0.1f, 0.4f}, glm::vec3{0.4f, 0, 0.4f}}) {
      const MirroredLamp lamp(at.alpha, size, at.half_deg);
      const std::vector<double> exact = lamp.exact();
      for (const int samples : {4, 16, 64}) {
        const Error error = error_of(lamp, exact, samples, 6);
        std::cout << "alpha " << at.alpha << ", " << size.y << " m high, " << samples << " samples: mean "
                  << error.mean << " +- " << error.standard_error << ", RMS " << error.rms << ", brightest "
                  << error.brightest << "\n";
        // Four standard errors, and 0.003 for the midpoints of the exact integral, whose cells the lamp's
        // edges cut: a cell is 1 / 128 of the lobe along each axis, and a pixel at an edge errs by 1 / 256 of
        // it at most.
        EXPECT_NEAR(error.mean, 1, 4 * error.standard_error + 0.003);
        // 32 directions in a lobe that an edge divides have a deviation of 0.5 x 32^(-3/4) = 0.04 of its
        // light (Hammersley's points; 0.09 if they were independent), and a highlight's darker half makes
        // that twice as much of the mean.
        if (samples == 64) {
          EXPECT_LE(error.rms, 0.1);
        }
        EXPECT_LE(error.brightest, 1.2);
      }
    }
  }
}

TEST(NarrowHighlightTest, ShowsWhatHidesTheLamp) {
  for (const Case& at : kCases) {
    const MirroredLamp lamp(at.alpha, {0.4f, 0.1f, 0.4f}, at.half_deg, true);
    const std::vector<double> exact = lamp.exact();
    const Error error = error_of(lamp, exact, 64, 6);
    std::cout << "alpha " << at.alpha << ": mean " << error.mean << " +- " << error.standard_error << ", RMS "
              << error.rms << "\n";
    EXPECT_NEAR(error.mean, 1, 4 * error.standard_error + 0.003);
    // Eight groups of directions, of which an edge crosses two or three: sqrt(2.5) / 2 / 8 = 0.1 of the lobe.
    EXPECT_LE(error.rms, 0.25);
    EXPECT_LE(error.brightest, 1.2);
  }
}

TEST(NarrowHighlightTest, OfCoatsAndStretchedOnesHasTheSameEnergyWithFewSamplesAsWithMany) {
  MirroredLamp coat(0.4, {0.4f, 0.1f, 0.4f}, 3), both(0.012, {0.4f, 0.1f, 0.4f}, 3), stretched = both;
  for (MirroredLamp* lamp : {&coat, &both}) {
    lamp->scene.materials[0].clearcoat.strength = 1;
    lamp->scene.materials[0].clearcoat.roughness = 0.1f;
  }
  stretched.scene.materials[0].anisotropy.strength = 0.3f;
  for (const MirroredLamp* lamp : {&coat, &both, &stretched}) {
    const RenderedFrame many = lamp->render(1024, 1);
    std::vector<double> reference;
    test::for_each_pixel(many.viewports[0],
                         [&](int, int, const test::Pixel& pixel) { reference.push_back(pixel[0]); });
    const Error error = error_of(*lamp, reference, 16, 16);
    std::cout << "mean " << error.mean << " +- " << error.standard_error << ", RMS " << error.rms << "\n";
    // Four standard errors, and 0.002 for those of the picture with 64 times the samples.
    EXPECT_NEAR(error.mean, 1, 4 * error.standard_error + 0.002);
  }
}

TEST(NarrowHighlightTest, OfAPlateIsTheSameWhereItHangsOnACeiling) {
  // What lies in the plate's plane hides none of it: shadow rays end a 4096th of their way before their
  // place.
  MirroredLamp open(0.05, {1.6f, 0, 1.6f}, 8), hung = open;
  test::add(hung.scene, test::quad({-5, 1.4f, -5}, {10, 0, 0}, {0, 0, 10}), test::matte(glm::vec3{0.0f}));
  test::expect_same_bits(open.render(64, 1), hung.render(64, 1));
}

TEST(NarrowHighlightTest, OfOneSampleHasTheEnergyOfTheWholeLamp) {
  // The whole highlight and what it is spread over: 45 degrees about it.
  const MirroredLamp lamp(0.02, {0.4f, 0.1f, 0.4f}, 45);
  const RenderedFrame one = lamp.render(1, 1), many = lamp.render(64, 1);
  double sum = 0, expected = 0;
  test::for_each_pixel(one.viewports[0], [&](int, int, const test::Pixel& pixel) { sum += pixel[0]; });
  test::for_each_pixel(many.viewports[0], [&](int, int, const test::Pixel& pixel) { expected += pixel[0]; });
  EXPECT_NEAR(sum / expected, 1, 0.1);
}

TEST(NarrowHighlightTest, AdaptiveSamplesOfPolishedMetalAreAllOfThemBitForBit) {
  const MirroredLamp lamp(0.003, {0.4f, 0.1f, 0.4f}, 0.8);
  test::expect_same_bits(lamp.render(64, 1), lamp.render(64, 1, 8));
}

TEST(NarrowHighlightTest, RoughSurfacesTraceNoFurtherRaysAndSmoothOnesAnEighthMore) {
  // The lamp is 1.4 m away: across one of 4 x 1 x 4 strata half vectors turn by 0.05 / 1.4, 8 x 0.036^2 =
  // 0.1^2.
  const MirroredLamp rough(0.13, {0.4f, 0.1f, 0.4f}, 3), smooth(0.05, {0.4f, 0.1f, 0.4f}, 3);
  constexpr std::int64_t kHits = 16 * 16;
  EXPECT_EQ(rough.render(16, 1).counters.rays[RayKind::shadow], kHits * 16);
  const std::int64_t rays = smooth.render(16, 1).counters.rays[RayKind::shadow];
  EXPECT_GT(rays, kHits * 17);
  EXPECT_LE(rays, kHits * (16 + 2));  // none where no direction meets the lamp
}

}  // namespace
}  // namespace herr
