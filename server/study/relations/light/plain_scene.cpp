#include "server/study/relations/light/plain_scene.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {

constexpr int kFewProbeRays = 16;
constexpr double kFewProbesDensity = 0.5, kLeastProbeDensity = 0.125;
constexpr int kMostTries = 8, kMostDarkTries = 2;
constexpr int kBrightestExponent = -3;
constexpr double kNearLargestHalf = 60000;
constexpr float kOutOfTheDark = 0x1p20f;

}  // namespace

void show_plainly(RelationCase& subject) {
  subject.settings.exposure_ev = 0.0;
  subject.settings.auto_exposure = false;
  subject.settings.filter = ResampleFilter::bilinear;
  subject.settings.gaze_marker = subject.settings.debug_tiles = false;
  subject.scene.exposure.reset();
  for (Material& material : subject.scene.materials) material.unlit = false;
}

void make_matte(Scene& scene) {
  for (Material& material : scene.materials) {
    material.metallic = material.transmission = 0;
    material.mirror = 0.0f;
    material.roughness = 1;
    material.specular = 0;
    material.specular_texture = material.transmission_texture = material.occlusion_texture = {};
    material.refractive_index = 1.5f;
    material.clearcoat = {};
    material.sheen = {};
    material.anisotropy = {};
    material.attenuation = {};
    material.unlit = false;
  }
}

void paint_all(Scene& scene, float albedo) {
  make_matte(scene);
  for (Material& material : scene.materials) {
    material.base_colour = glm::vec3(albedo);
    material.base_colour_texture = -1;
    material.alpha_mode = AlphaMode::opaque;
    material.double_sided = true;
  }
  for (TriangleMesh& mesh : scene.meshes) mesh.colours.clear();
}

void trace_few_probe_rays(RenderSettings& settings) {
  settings.probes.rays = std::min(settings.probes.rays, kFewProbeRays);
  settings.probes.density = std::max(kFewProbesDensity * settings.probes.density, kLeastProbeDensity);
}

void take_catchers_away(Scene& scene) {
  for (Instance& instance : scene.instances) instance.present = instance.present && !instance.catcher;
}

void scale_light(RelationCase& subject, float factor) {
  for (AreaLight& light : subject.scene.lights) light.intensity_w_sr *= factor;
  for (AreaLight& light : subject.state.lights) light.intensity_w_sr *= factor;
  for (Material& material : subject.scene.materials) material.emission *= factor;
  subject.scene.ambient *= factor;
  subject.scene.environment *= factor;
  for (float& value : subject.scene.environment_map.rgba) value *= factor;
}

void switch_lights_off(RelationCase& subject) {
  for (AreaLight& light : subject.scene.lights) light.intensity_w_sr = glm::vec3(0.0f);
  for (AreaLight& light : subject.state.lights) light.intensity_w_sr = glm::vec3(0.0f);
}

void make_environment_black(Scene& scene) {
  scene.environment = glm::vec3(0.0f);
  scene.environment_map = {};
}

void stop_emission(Scene& scene) {
  for (Material& material : scene.materials) {
    material.emission = glm::vec3(0.0f);
    material.emission_texture = {};
  }
}

double largest_value(const std::vector<LinearPicture>& pictures) {
  double largest = 0;
  for (const LinearPicture& picture : pictures) {
    for (const auto& plane : picture.plane) {
      for (const float value : plane) {
        if (std::isfinite(value)) largest = std::max(largest, double{value});
      }
    }
  }
  return largest;
}

double moderate_light(RelationCase& subject) {
  double largest = 0;
  for (int tries = 0, dark = 0; tries < kMostTries && dark < kMostDarkTries; ++tries) {
    largest = largest_value(picture_of(subject));
    dark += largest > 0 ? 0 : 1;
    const int exponent = largest > 0 ? std::ilogb(largest) : 0;
    if (exponent == kBrightestExponent && largest > 0) return largest;
    const float factor = largest > 0 ? std::ldexp(1.0f, kBrightestExponent - exponent) : kOutOfTheDark;
    scale_light(subject, factor);
    // Where neither end of the half floats was near, the picture is the same times the factor.
    if (largest > kSmallestNormalHalf && largest < kNearLargestHalf) return largest * double{factor};
  }
  return largest;
}

}  // namespace herr
