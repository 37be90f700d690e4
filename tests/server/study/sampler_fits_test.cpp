// Light samplers told apart by how their error falls: strata, independent places, and adaptive samples, whose
// error has a floor. The error is that of the visible share in the penumbra of a straight edge.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <iostream>
#include <utility>
#include <vector>

#include "server/study/statistics/power_fit.h"
#include "tests/renderer/penumbra_scene.h"
#include "tests/renderer/rendered_frames.h"

namespace herr {
namespace {

struct Sampling {
  glm::vec3 light_size{1, 0, 1};
  LightSampler sampler = LightSampler::jittered;
  int first_samples = 0;
};

// Errors of visible shares over all pixels of several seeds: of single pictures, and of their mean.
struct ShareError {
  double rms = 0, rms_of_mean = 0;
};

class Penumbra {
 public:
  // Held against the shares of a light of `true_size`.
  Penumbra(const Sampling& sampling, const glm::vec3& true_size, int width_px, int height_px)
      : sampling_(sampling),
        scene_(test::edge_scene(sampling.light_size)),
        open_(scene_),
        view_(test::penumbra_view(width_px, height_px)),
        // A sixteenth of the light and its square, 1/256, against errors of 0.01: the rule's own is far
        // below.
        exact_(test::exact_shares(test::edge_scene(true_size).lights[0], view_.viewports[0], 16)) {
    open_.instances.pop_back();
  }

  ShareError error(int samples, std::uint32_t seeds) const {
    RenderSettings settings = test::planar_settings();
    settings.light_samples = samples;
    settings.light_sampler = sampling_.sampler;
    settings.adaptive_min_samples = sampling_.first_samples;
    Renderer shadowed(scene_, view_, settings, false);
    settings.adaptive_min_samples = 0;  // nothing is in the way
    Renderer unshadowed(open_, view_, settings, false);
    std::vector<double> sum(exact_.size());
    double squares = 0;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
      const std::vector<double> shares =
          test::shares_of(picture(shadowed, scene_, seed), picture(unshadowed, open_, seed));
      for (std::size_t i = 0; i < shares.size(); ++i) {
        const double off = shares[i] - exact_[i];
        squares += off * off, sum[i] += off;
      }
    }
    double squares_of_mean = 0;
    for (const double off : sum) squares_of_mean += (off / seeds) * (off / seeds);
    const auto pixels = static_cast<double>(exact_.size());
    return {std::sqrt(squares / (pixels * seeds)), std::sqrt(squares_of_mean / pixels)};
  }

 private:
  static ViewportImage picture(Renderer& renderer, const Scene& scene, std::uint32_t seed) {
    SceneState state;
    scene_state_at(scene, 0, state);
    PixelPass pass;
    pass.seed = seed;
    RenderedFrame frame;
    renderer.render_pass(test::penumbra_sample(), state, pass, frame);
    return std::move(frame.viewports[0]);
  }

  Sampling sampling_;
  Scene scene_, open_;
  DisplayProfile view_;
  std::vector<double> exact_;
};

void print(const char* name, const PowerFit& fit) {
  std::cout << name << ": p = " << fit.p.estimate << " [" << fit.p.lower << ", " << fit.p.upper << "], floor "
            << fit.floor.estimate << " [" << fit.floor.lower << ", " << fit.floor.upper << "], residuals "
            << fit.relative_rms << "\n";
}

// Of all pixels and 8 seeds: the light sampler's own noise.
PowerFit fit_of(const char* name, const Sampling& sampling, const std::vector<double>& samples) {
  const Penumbra penumbra(sampling, sampling.light_size, 48, 12);
  std::vector<double> errors;
  for (const double n : samples) {
    errors.push_back(penumbra.error(static_cast<int>(n), 8).rms);
    std::cout << name << ", " << n << " samples: RMS error " << errors.back() << "\n";
  }
  const PowerFit fit = fit_power(samples, errors, false).value();
  print(name, fit);
  return fit;
}

// n x n strata: the edge crosses n of them, each a coin, so the share's deviation is a constant times
// sqrt(n) / n^2 = N^(-3/4). Independent places: N^(-1/2).
TEST(SamplerFitsTest, StrataFallByThreeQuartersAndIndependentPlacesByHalf) {
  const std::vector<double> samples{4, 9, 16, 36, 64, 144, 256};
  const PowerFit strata = fit_of("strata of a flat light", {}, samples);
  EXPECT_LE(strata.p.estimate, -0.7);
  EXPECT_LT(strata.p.upper, -0.5) << "the fit must tell strata from independent places";
  const PowerFit places = fit_of("independent places", {{1, 0, 1}, LightSampler::random, 0}, samples);
  EXPECT_NEAR(places.p.estimate, -0.5, 0.05);
  EXPECT_LT(strata.p.upper, places.p.lower);
}

// n^3 strata, of which the edge's plane crosses about n^2: n / n^3 = N^(-2/3).
TEST(SamplerFitsTest, StrataOfABoxFallByTwoThirds) {
  const PowerFit box =
      fit_of("strata of a box", {{1, 0.6f, 1}, LightSampler::jittered, 0}, {8, 27, 64, 125, 216});
  EXPECT_NEAR(box.p.estimate, -2.0 / 3, 0.05);
  EXPECT_LT(box.p.upper, -0.5);
}

const glm::vec3 kSmallLight{0.3f, 0, 0.3f};

struct FloorFits {
  PowerFit single, mean;  // of single pictures' error, and of that of the mean picture
};

// 64 seeds: the noise of a mean picture is an eighth of that of one.
FloorFits floors_of(const char* name, const glm::vec3& true_size, const std::vector<double>& samples) {
  const Penumbra penumbra({kSmallLight, LightSampler::jittered, 0}, true_size, 48, 4);
  std::vector<double> single, mean;
  for (const double n : samples) {
    const ShareError error = penumbra.error(static_cast<int>(n), 64);
    single.push_back(error.rms), mean.push_back(error.rms_of_mean);
    std::cout << name << ", " << n << " samples: RMS error " << error.rms << ", of the mean of 64 seeds "
              << error.rms_of_mean << "\n";
  }
  const FloorFits fits{fit_power(samples, single, true).value(), fit_power(samples, mean, true).value()};
  print(name, fits.single);
  print(name, fits.mean);
  return fits;
}

// A light that is drawn by 4 % too small: its penumbra ends 6 mm too early on both sides. That bias is no
// noise, and more samples do not take it away.
TEST(SamplerFitsTest, ABiasedSettingIsCaughtByItsFloor) {
  const std::vector<double> samples{16, 36, 64, 100, 144, 256};
  const ShareError best =
      Penumbra({kSmallLight, LightSampler::jittered, 0}, kSmallLight, 48, 4).error(256, 64);
  std::cout << "all of 256: RMS error " << best.rms << ", of the mean of 64 seeds " << best.rms_of_mean
            << "\n";
  const FloorFits biased = floors_of("drawn too small", kSmallLight / 0.96f, {4, 9, 16, 36, 64, 144, 256});
  EXPECT_GT(biased.single.floor.estimate, best.rms);
  // The mean picture's floor lies, with all its interval, even above the error of a single one.
  EXPECT_GT(biased.mean.floor.lower, best.rms);
  // Without bias there is no floor that the fit could tell from none.
  const FloorFits none = floors_of("as it is", kSmallLight, samples);
  EXPECT_LT(none.single.floor.lower, 0.1 * best.rms);
  EXPECT_LT(none.mean.floor.lower, 0.1 * best.rms_of_mean);
}

// What adaptive samples are off by is noise, less than that of all of 16 samples; in the mean of 64 seeds
// little more is left than the one hit by which they blur penumbrae.
TEST(SamplerFitsTest, AdaptiveSamplesAreRightInTheMean) {
  const ShareError all = Penumbra({kSmallLight, LightSampler::jittered, 0}, kSmallLight, 48, 4).error(16, 64);
  for (const int first : {4, 8}) {
    const Penumbra adaptive({kSmallLight, LightSampler::jittered, first}, kSmallLight, 48, 4);
    for (const int samples : {32, 64, 128}) {
      const ShareError error = adaptive.error(samples, 64);
      EXPECT_LE(error.rms, all.rms) << first << " of " << samples;
      EXPECT_LE(error.rms_of_mean, 0.005) << first << " of " << samples;
    }
  }
}

}  // namespace
}  // namespace herr
