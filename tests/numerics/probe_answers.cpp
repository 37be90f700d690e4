// The integrating sphere: light of a closed room whose walls return the share rho of it grows by rho / (1 -
// rho).
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "tests/numerics/exact_answer.h"
#include "tests/renderer/probes/probe_scenes.h"

namespace herr::test {
namespace {

constexpr double kResidual = 1e-4;  // of the series' sum, when frames end

// Light by other surfaces at what a view of 80 degrees meets, mean over hits, as look-ups give it: before
// pixels round it to half floats.
double light_by_others(double albedo) {
  Scene scene;
  Instance ball;
  ball.name = "ball";
  ball.kind = ShapeKind::sphere;
  scene.instances = {ball};
  scene.materials = {matte(glm::vec3{static_cast<float>(albedo)})};
  scene.lights = {light_at({0, 0, 0}, glm::vec3{1.0f})};
  scene.probes.counts = {5, 5, 5};
  ProbeRun run(scene, single_view(kTileSide, kTileSide, 40, 40), probe_settings(0), sample_from({0, 0, 0}));
  run.run(static_cast<int>(std::ceil(std::log(kResidual) / std::log(albedo))));
  Renderer::Impl& impl = run.renderer.internals();
  impl.run_tile(0, 0, nullptr);
  const HitBatch& hits = impl.tile_scratch[0]->first;
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < std::size_t{kTileRays}; ++i) {
    if (hits.kind[i] != static_cast<int>(HitKind::object)) continue;
    sum += double{hits.indirect.y[i]}, count += 1;
  }
  return sum / count;
}

// The mean of I cos / d^2 over a closed sphere is I / R^2 wherever the light stands in it. Each bounce
// returns rho of it, evenly: L = rho / (1 - rho) I / (pi R^2) by other surfaces.
double exact_light(double albedo) {
  return albedo / (1 - albedo) / glm::pi<double>();
}

double gain_error(double albedo) {
  return std::abs(light_by_others(albedo) / exact_light(albedo) - 1);
}
double dark_sphere() {
  return gain_error(0.2);
}
double grey_sphere() {
  return gain_error(0.5);
}
double bright_sphere() {
  return gain_error(0.95);
}

constexpr const char* kSeries =
    "what the series lacks when frames end, 1e-4, and a rounding to 13 bits, 2^-14, at each bounce: over 1 - "
    "rho";
constexpr ExactAnswer kProbeAnswers[] = {
    {"DarkSphere", "light by other surfaces in a closed sphere of albedo 0.2, a point light in its middle",
     dark_sphere, 1e-4 + 0x1p-14 / 0.8, "relative", kSeries},
    {"GreySphere", "the same of albedo 0.5", grey_sphere, 1e-4 + 0x1p-14 / 0.5, "relative", kSeries},
    {"BrightSphere", "the same of albedo 0.95: twenty times the light", bright_sphere, 1e-4 + 0x1p-14 / 0.05,
     "relative", kSeries},
};

}  // namespace

std::span<const ExactAnswer> probe_answers() {
  return kProbeAnswers;
}

}  // namespace herr::test
