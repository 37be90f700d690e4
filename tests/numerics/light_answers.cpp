// Direct light on a floor and shares of the sky above it, against form factors in closed form: of lines and
// rectangles that shine, of the edge that cuts a shadow, of a plate that hides the sky.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "tests/numerics/exact_answer.h"
#include "tests/renderer/half_pixels.h"
#include "tests/renderer/penumbra_scene.h"
#include "tests/renderer/test_scenes.h"

namespace herr::test {
namespace {

// Scatters evenly and has no highlight.
Material lambert() {
  Material material = matte(glm::vec3{0.8f});
  material.specular = 0;
  return material;
}

double mean_green(const ViewportImage& image) {
  double sum = 0;
  for_each_pixel(image, [&](int, int, const Pixel& pixel) { sum += pixel[1]; });
  return sum / (image.width_px * image.height_px);
}

// How far the irradiance of a floor in the origin lies from `exact` (of intensity 1), relative.
double floor_error(const AreaLight& light, int samples, double exact) {
  Scene scene;
  add(scene, floor_quad(20), lambert());
  scene.lights = {light};
  RenderSettings settings = planar_settings();
  settings.light_samples = samples;
  const RenderedFrame frame =
      render(scene, single_view(16, 16, 0.01, 0.01), settings, looking_down({0, 0.05, 0}));
  return std::abs(mean_green(frame.viewports[0]) * glm::pi<double>() / (0.8 * exact) - 1);
}

double point_above() {
  return floor_error(light_at({0, 1.5, 0}, glm::vec3{1.0f}), 1, 1 / (1.5 * 1.5));
}

// Of a line of length l parallel to the floor at height h: the mean of h / r^3 is 1 / (h sqrt(h^2 + l^2 /
// 4)).
double line_error(double height, double length) {
  return floor_error(light_at({0, height, 0}, glm::vec3{1.0f}, {static_cast<float>(length), 0, 0}), 256,
                     1 / (height * std::sqrt(height * height + length * length / 4)));
}
double line_near() {
  return line_error(0.5, 1);
}
double line_far() {
  return line_error(5, 1);
}

// Of a rectangle of a x b: h / r^3 is the solid angle of an area, so the mean is its solid angle over its
// area.
double rectangle_error(double height, double a, double b) {
  const double reach = std::sqrt(a * a / 4 + b * b / 4 + height * height);
  const double solid_angle = 4 * std::atan(a * b / 4 / (height * reach));
  const glm::vec3 size{static_cast<float>(a), 0, static_cast<float>(b)};
  return floor_error(light_at({0, height, 0}, glm::vec3{1.0f}, size), 1024, solid_angle / (a * b));
}
double rectangle_near() {
  return rectangle_error(0.5, 1, 1);
}
double rectangle_far() {
  return rectangle_error(5, 1, 0.5);
}

// Mean of the visible share of a light behind a straight edge, against its mean in double: signed, so that
// noise falls with the number of pixels; `deviation` of one pixel.
double penumbra_bias(const glm::vec3& light_size, int samples, double deviation) {
  const Scene scene = edge_scene(light_size);
  const DisplayProfile profile = penumbra_view(64, 12);
  RenderSettings settings = planar_settings();
  settings.light_samples = samples;
  const RenderedFrame behind = render(scene, profile, settings, penumbra_sample());
  Scene open = scene;
  open.instances.pop_back();
  const RenderedFrame unshadowed = render(open, profile, settings, penumbra_sample());
  const std::vector<double> seen = shares_of(behind.viewports[0], unshadowed.viewports[0]),
                            exact = exact_shares(scene.lights[0], profile.viewports[0], 24);
  double sum = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) sum += seen[i] - exact[i];
  const auto pixels = static_cast<double>(seen.size());
  return std::abs(sum / pixels) / (deviation / std::sqrt(pixels));
}
double penumbra_of_square() {
  return penumbra_bias({1, 0, 1}, 64, 0.5 * std::pow(64, -0.75));
}
double penumbra_of_box() {
  return penumbra_bias({1, 0.6f, 1}, 64, 0.5 * std::pow(64, -2.0 / 3));
}

// A square plate of side 2 at height 1 hides 4 / (pi sqrt 2) atan(1 / sqrt 2) of the sky's weighted by its
// cosine: four times the form factor of a unit square over its corner (any table of view factors). Three by
// three blocks have 18 strata of directions between them, turned by a random number of the frame: of each
// frame they are what it has of independent rays.
double hidden_by_plate() {
  constexpr int kSide = 12, kRaysEach = 64, kFrames = 228;
  Scene scene;
  add(scene, floor_quad(20), lambert());
  add(scene, quad({-1, 1, 1}, {2, 0, 0}, {0, 0, -2}), lambert());
  scene.ambient = glm::vec3{1.0f};
  RenderSettings settings = planar_settings();
  settings.occlusion_rays = kRaysEach;
  settings.occlusion_radius_m = 100;
  double open = 0;
  for (int i = 0; i < kFrames; ++i) {
    settings.seed = static_cast<std::uint32_t>(i);
    const RenderedFrame frame =
        render(scene, single_view(kSide, kSide, 0.01, 0.01), settings, looking_down({0, 0.5, 0}));
    open += mean_green(frame.viewports[0]) / kFrames;
  }
  const double hidden = 1 - open / 0.8;
  const double exact = 4 / (glm::pi<double>() * std::sqrt(2.0)) * std::atan(1 / std::sqrt(2.0));
  const double rays = 18.0 * kRaysEach * kFrames;
  return std::abs(hidden - exact) / std::sqrt(exact * (1 - exact) / rays);
}

constexpr double kPixelStep = 0x1p-11 + 0x1p-18;
constexpr const char* kPixelRounding =
    "half a step of the half floats that pixels are kept in, 2^-11 at most, and 64 roundings to float";
constexpr ExactAnswer kLightAnswers[] = {
    {"PointAbove", "irradiance 1.5 m below a point light", point_above, kPixelStep, "relative",
     kPixelRounding},
    {"LineNear", "irradiance below a light of 1 m x 0 x 0, half a metre away", line_near,
     kPixelStep + 0x1p-14, "relative",
     "half floats, 2^-11, and 4 standard errors of chance: h / r^3 changes by 3.3 / m of "
     "its mean at most, over 256 strata of 256 pixels"},
    {"LineFar", "the same 5 m away", line_far, kPixelStep, "relative", kPixelRounding},
    {"RectangleNear", "irradiance below a light of 1 m x 0 x 1 m, half a metre away", rectangle_near,
     kPixelStep + 3.3e-4, "relative",
     "half floats, 2^-11, and 4 standard errors of chance: h / r^3 changes by 3.3 / m of "
     "its mean at most along either axis, over 1024 strata of 256 pixels"},
    {"RectangleFar", "irradiance below a light of 1 m x 0 x 0.5 m, 5 m away", rectangle_far, kPixelStep,
     "relative", kPixelRounding},
    {"PenumbraOfASquare", "mean visible share of a square light behind a straight edge, 64 samples",
     penumbra_of_square, 4, "standard errors",
     "chance: the edge crosses 8 of 8 x 8 strata, each a coin of deviation 1/2 at most"},
    {"PenumbraOfABox", "mean visible share of a box light behind a straight edge, 64 samples",
     penumbra_of_box, 4, "standard errors", "chance: the edge crosses 16 of 4 x 4 x 4 strata, each a coin"},
    {"HiddenByAPlate", "share of the sky that a square plate hides, by occlusion rays", hidden_by_plate, 4,
     "standard errors", "chance of 262,656 independent rays; that theirs lie in strata makes it less"},
};

}  // namespace

std::span<const ExactAnswer> light_answers() {
  return kLightAnswers;
}

}  // namespace herr::test
