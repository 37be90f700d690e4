// How the error of the polar buffer falls with its size, by filter: on smooth shading by the filter's order,
// at edges by less. The error is that against one ray per pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <iostream>
#include <utility>
#include <vector>

#include "server/study/statistics/power_fit.h"
#include "tests/renderer/half_pixels.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

const std::vector<double>& sizes() {
  static const std::vector<double> all{64, 96, 128, 192, 256, 384, 512};
  return all;
}

// A matte wall 2 m ahead that fills the view, and a point of light 1 m before it: nothing has an edge.
Scene smooth_wall() {
  Scene scene;
  test::add(scene, test::quad({-20, -20, -2}, {40, 0, 0}, {0, 40, 0}), test::matte(glm::vec3{0.5f}));
  scene.lights = {test::light_at({0.3, 0.2, -1.6}, glm::vec3{0.7f})};
  return scene;
}

// And a board half way, which stands out against it and throws its shadow on it.
Scene with_edges() {
  Scene scene = smooth_wall();
  test::add(scene, test::quad({-0.7f, -0.31f, -1.2f}, {0.43f, 0.05f, 0}, {-0.04f, 0.52f, 0}),
            test::matte(glm::vec3{0.1f}));
  return scene;
}

std::vector<double> greens(const RenderedFrame& frame) {
  std::vector<double> values;
  test::for_each_pixel(frame.viewports[0], [&](int, int, const test::Pixel& p) { values.push_back(p[1]); });
  return values;
}

struct Errors {
  std::vector<double> exact, rms;  // pixels; of each size
  PowerFit fit;
};

Errors errors_of(const char* name, const Scene& scene, ResampleFilter filter) {
  const DisplayProfile view = test::single_view(120, 120, 30, 30);
  const FrameSample sample = test::sample_from({0, 0, 0}, test::gaze_deg(-8, 3));
  const std::vector<double> exact = greens(test::render(scene, view, test::planar_settings(), sample));
  RenderSettings settings = test::small_settings();
  settings.filter = filter;
  Errors errors{exact, {}, {}};
  for (const double size : sizes()) {
    settings.polar_width = settings.polar_height = static_cast<int>(size);
    const std::vector<double> values = greens(test::render(scene, view, settings, sample));
    double squares = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      squares += (values[i] - exact[i]) * (values[i] - exact[i]);
    }
    errors.rms.push_back(std::sqrt(squares / static_cast<double>(values.size())));
    std::cout << name << ", " << size << " x " << size << ": RMS error " << errors.rms.back() << "\n";
  }
  errors.fit = fit_power(sizes(), errors.rms, true).value();
  std::cout << name << ": p = " << errors.fit.p.estimate << " [" << errors.fit.p.lower << ", "
            << errors.fit.p.upper << "], floor " << errors.fit.floor.estimate << " ["
            << errors.fit.floor.lower << ", " << errors.fit.floor.upper << "]\n";
  return errors;
}

// RMS of rounding every value to half once: evenly within half a unit in the last place, 2^-11 of the power
// of two at or below it, to either side.
double rounding_of(const std::vector<double>& values) {
  double squares = 0;
  for (const double value : values) {
    const double unit = std::exp2(std::floor(std::log2(value)) - 10);
    squares += unit * unit / 12;
  }
  return std::sqrt(squares / static_cast<double>(values.size()));
}

// A filter of order k leaves k-th derivatives times the spacing of samples to the k-th power: -1, -2, -3 (of
// third derivatives; Catmull-Rom). What is left in the end is rounding: of one picture's pixels and of the
// other's, and of the texels between which a pixel lies. A blend of four texels keeps (2/3)^2 of one's
// variance in the mean: between sqrt(2) and sqrt(3) roundings. Errors add up by their squares, while the fit
// adds a floor as such: at most what is there, and a little steeper a power.
TEST(ResolutionFitsTest, OnSmoothShadingErrorsFallByTheFiltersOrderDownToRounding) {
  const Scene scene = smooth_wall();
  const Errors nearest = errors_of("nearest", scene, ResampleFilter::nearest),
               bilinear = errors_of("bilinear", scene, ResampleFilter::bilinear),
               bicubic = errors_of("bicubic", scene, ResampleFilter::bicubic);
  const double rounding = rounding_of(bilinear.exact);
  std::cout << "one rounding: " << rounding << "\n";
  EXPECT_NEAR(nearest.fit.p.estimate, -1, 0.1);
  EXPECT_LE(bilinear.fit.p.upper, -0.9);
  EXPECT_NEAR(bilinear.fit.p.estimate, -2, 0.4);
  for (const Errors& errors : {bilinear, bicubic}) {
    EXPECT_GT(errors.fit.floor.estimate, rounding);
    EXPECT_LT(errors.fit.floor.estimate, std::sqrt(3.0) * rounding);
  }
  // Coarse, the better filter has the smaller error at equal size; at 512 all but nearest are rounding.
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(bilinear.rms[i], nearest.rms[i] / 5) << sizes()[i];
    EXPECT_LT(bicubic.rms[i], bilinear.rms[i] / 2) << sizes()[i];
  }
}

// At an edge pixels are wrong by a share of its contrast within a sample of it: the area falls with the
// spacing, its square root is what RMS shows, -1/2 for every filter.
TEST(ResolutionFitsTest, AtEdgesErrorsFallByAboutHalf) {
  const Scene scene = with_edges();
  for (const auto& [name, filter] : {std::pair{"edges, bilinear", ResampleFilter::bilinear},
                                     {"edges, bicubic", ResampleFilter::bicubic}}) {
    const Errors edges = errors_of(name, scene, filter);
    EXPECT_LT(edges.fit.p.upper, 0);
    EXPECT_GT(edges.rms.back(), 10 * rounding_of(edges.exact)) << "far from the floor of smooth shading";
  }
}

}  // namespace
}  // namespace herr
