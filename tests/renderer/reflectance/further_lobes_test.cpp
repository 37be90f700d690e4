// Clear coats, sheen and stretched highlights against the formulae of their glTF extensions, in double, and
// against the law that nothing sends back more light than comes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "renderer/reflectance/reflectance-inl.h"
#include "tests/renderer/direct_light/scalar_light.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

namespace kernels = HWY_NAMESPACE;

constexpr double kTurn = 2 * glm::pi<double>();

void fill(Lane3& lanes, const glm::dvec3& v) {
  lanes.x.fill(static_cast<float>(v.x));
  lanes.y.fill(static_cast<float>(v.y));
  lanes.z.fill(static_cast<float>(v.z));
}

// What a surface in z = 0 is made of.
struct Layers {
  glm::dvec3 diffuse{0.0}, f0{0.04};
  double roughness = 0.5, coat = 0, coat_roughness = 0.5;
  glm::dvec3 sheen{0.0};
  double sheen_roughness = 0.5, stretch = 0;
  glm::dvec3 coat_normal{0, 0, 1};
};

// A vector of hits on one surface, all seen from one side, with their layers laid.
class Surface {
 public:
  Surface(const Layers& of, const glm::dvec3& viewer) : hits_(std::make_unique<HitBatch>()) {
    hits_->lobes = std::make_unique<FurtherLobes>();
    FurtherLobes& lobes = *hits_->lobes;
    const auto alpha = [](double roughness) { return static_cast<float>(roughness * roughness); };
    fill(hits_->normal, {0, 0, 1});
    fill(hits_->viewer, viewer);
    fill(hits_->diffuse, of.diffuse);
    fill(hits_->f0, of.f0);
    hits_->f90.fill(1);
    hits_->alpha2.fill(alpha(of.roughness) * alpha(of.roughness));
    lobes.coat.fill(static_cast<float>(of.coat));
    lobes.coat_alpha2.fill(alpha(of.coat_roughness) * alpha(of.coat_roughness));
    fill(lobes.coat_normal, of.coat_normal);
    fill(lobes.sheen, of.sheen);
    lobes.sheen_alpha.fill(alpha(of.sheen_roughness));
    fill(lobes.tangent, {1, 0, 0});
    lobes.stretch.fill(static_cast<float>(of.stretch));
    kernels::cover_bases(*hits_, kernels::kLanes);
  }

  // Radiance per unit of irradiance from kLanes directions at once. `turn`: what the half vector turns by
  // across a sample of the light.
  std::vector<glm::dvec3> response(const std::vector<glm::dvec3>& lights, float turn = 0) const {
    std::vector<glm::dvec3> all;
    for (std::size_t first = 0; first < lights.size(); first += kernels::kLanes) {
      alignas(64) float x[kMaxLanes] = {}, y[kMaxLanes] = {}, z[kMaxLanes] = {};
      const std::size_t count = std::min<std::size_t>(kernels::kLanes, lights.size() - first);
      for (int i = 0; i < kernels::kLanes; ++i) z[i] = 1;
      for (std::size_t i = 0; i < count; ++i) {
        x[i] = static_cast<float>(lights[first + i].x);
        y[i] = static_cast<float>(lights[first + i].y);
        z[i] = static_cast<float>(lights[first + i].z);
      }
      const kernels::V3 l = kernels::load3(x, y, z), n = kernels::load3(hits_->normal, 0);
      const kernels::V3 f = kernels::reflectance<kernels::Lobe::layered>(
          *hits_, 0, n, l, l.z, kernels::whole_highlights(kernels::set(turn * turn)));
      kernels::hn::Store(f.x, kernels::kF, x);
      kernels::hn::Store(f.y, kernels::kF, y);
      kernels::hn::Store(f.z, kernels::kF, z);
      for (std::size_t i = 0; i < count; ++i) all.push_back({x[i], y[i], z[i]});
    }
    return all;
  }

  // Light that goes to the viewer from all sides of radiance 1, by midpoints in the square root of the cosine
  // and the azimuth.
  double furnace(int steps) const {
    std::vector<glm::dvec3> lights;
    std::vector<double> weights;
    for (int i = 0; i < steps; ++i) {
      const double u = (i + 0.5) / steps, cosine = u * u, sine = std::sqrt(1 - cosine * cosine);
      for (int j = 0; j < steps; ++j) {
        const double azimuth = kTurn * (j + 0.5) / steps;
        lights.push_back({sine * std::cos(azimuth), sine * std::sin(azimuth), cosine});
        weights.push_back(cosine * 2 * u / steps * kTurn / steps);
      }
    }
    const std::vector<glm::dvec3> f = response(lights);
    double sum = 0;
    for (std::size_t i = 0; i < f.size(); ++i) sum += f[i].x * weights[i];
    return sum;
  }

 private:
  std::unique_ptr<HitBatch> hits_;
};

glm::dvec3 towards(double cosine, double azimuth) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

std::vector<glm::dvec3> some_directions() {
  std::vector<glm::dvec3> all;
  for (const double cosine : {0.07, 0.3, 0.6, 0.85, 0.99}) {
    for (const double azimuth : {0.1, 1.0, 2.2, 3.3, 4.9}) all.push_back(towards(cosine, azimuth));
  }
  return all;
}

double ggx(double n_h, double alpha) {
  const double d = n_h * n_h * (alpha * alpha - 1) + 1;
  return alpha * alpha / (0.5 * kTurn * d * d);
}
double hammon(double n_l, double n_v, double alpha) {
  return 0.5 / (alpha * (n_l + n_v) + (1 - alpha) * 2 * n_l * n_v);
}
double schlick(double f0, double cosine) {
  return f0 + (1 - f0) * std::pow(1 - cosine, 5);
}

template <typename Expected>
void expect_response(const Layers& layers, const Expected& expected) {
  for (const glm::dvec3& v : {towards(0.15, 0.5), towards(0.5, 4.0), towards(0.97, 2.0)}) {
    const std::vector<glm::dvec3> lights = some_directions();
    const std::vector<glm::dvec3> f = Surface(layers, v).response(lights);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const glm::dvec3 h = glm::normalize(lights[i] + v), e = expected(lights[i], v, h);
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(f[i][c], e[c], 2e-4 * e[c] + 1e-6) << "light " << i << " viewer " << v.z << " of " << c;
      }
    }
  }
}

TEST(FurtherLobesTest, ACoatAddsItsHighlightAndDimsWhatLiesBelow) {
  // KHR_materials_clearcoat: mix(base, D V, coat x Fresnel(0.04, N.V)), with the coat's own normal.
  Layers layers;
  layers.diffuse = {0.6, 0.3, 0.1};
  layers.coat = 0.8;
  layers.coat_roughness = 0.3;
  layers.coat_normal = glm::normalize(glm::dvec3{0.1, -0.05, 1});
  expect_response(layers, [&](const glm::dvec3& l, const glm::dvec3& v, const glm::dvec3& h) {
    const double alpha = 0.25, coat_alpha = 0.09;
    const double coat_v = std::abs(glm::dot(layers.coat_normal, v));
    const double coat_l = std::max(glm::dot(layers.coat_normal, l), 0.0);
    const double weight = 0.8 * schlick(0.04, coat_v);
    const double base = ggx(h.z, alpha) * hammon(l.z, v.z, alpha) * schlick(0.04, glm::dot(l, h));
    const double coat = ggx(glm::dot(layers.coat_normal, h), coat_alpha) * hammon(coat_l, coat_v, coat_alpha);
    // Irradiance is counted by the surface's normal: the coat's own is n.l of its normal.
    return (1 - weight) * (2.0 * layers.diffuse / kTurn + base) + weight * coat * coat_l / l.z;
  });
}

// The fit of Estevez & Kulla 2017, as KHR_materials_sheen states it.
double charlie_lambda(double cosine, double alpha) {
  const double t = (1 - alpha) * (1 - alpha);
  const auto mix = [&](double rough, double smooth) { return (1 - t) * rough + t * smooth; };
  const auto fit = [&](double x) {
    return mix(21.5473, 25.3245) / (1 + mix(3.82987, 3.32435) * std::pow(x, mix(0.19823, 0.16801))) +
           mix(-1.97760, -1.27393) * x + mix(-4.32054, -4.85967);
  };
  return std::exp(cosine < 0.5 ? fit(cosine) : 2 * fit(0.5) - fit(1 - cosine));
}
double charlie(const glm::dvec3& l, const glm::dvec3& v, const glm::dvec3& h, double alpha) {
  const double sine = std::sqrt(std::max(1 - h.z * h.z, 0.0));
  const double lobe = (2 + 1 / alpha) * std::pow(sine, 1 / alpha) / (kTurn);
  return lobe / ((1 + charlie_lambda(v.z, alpha) + charlie_lambda(l.z, alpha)) * 4 * l.z * v.z);
}
// Directional albedo by midpoints, as furnace().
double charlie_albedo(double cosine, double alpha, int steps) {
  const glm::dvec3 v = towards(cosine, 0);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double u = (i + 0.5) / steps;
    for (int j = 0; j < steps; ++j) {
      const glm::dvec3 l = towards(u * u, 0.5 * kTurn * (j + 0.5) / steps);
      sum += charlie(l, v, glm::normalize(l + v), alpha) * l.z * 2 * u / steps * kTurn / steps;
    }
  }
  return sum;
}

TEST(FurtherLobesTest, SheenIsCharliesLobeOverABaseThatGetsTheRest) {
  // KHR_materials_sheen, with the albedo at the viewer's angle; the table holds it to 0.015.
  Layers layers;
  layers.diffuse = {0.5, 0.5, 0.5};
  layers.f0 = glm::dvec3{0.0};
  layers.sheen = {0.9, 0.4, 0.2};
  layers.sheen_roughness = 0.6;
  for (const glm::dvec3& v : {towards(0.15, 0.5), towards(0.5, 4.0), towards(0.97, 2.0)}) {
    const std::vector<glm::dvec3> lights = some_directions();
    const std::vector<glm::dvec3> f = Surface(layers, v).response(lights);
    const double below = 1 - 0.9 * charlie_albedo(v.z, 0.36, 200);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const glm::dvec3 h = glm::normalize(lights[i] + v);
      const double alpha = 0.25, white = charlie(lights[i], v, h, 0.36);
      const double base = 1 / kTurn * below + ggx(h.z, alpha) * hammon(lights[i].z, v.z, alpha) * below *
                                                  std::pow(1 - glm::dot(lights[i], h), 5);
      for (int c = 0; c < 3; ++c) {
        const double expected = layers.sheen[c] * white + base;
        ASSERT_NEAR(f[i][c], expected, 2e-3 * layers.sheen[c] * white + 0.9 * 0.015 / below * base + 1e-6);
      }
    }
  }
}

TEST(FurtherLobesTest, TheTableOfSheenIsTheIntegralOfTheLobe) {
  double last = 0;
  for (const int i : {2, 4, 8, 12, 15}) {
    for (const int j : {3, 6, 9, 12, 15}) {
      const double roughness = i / 15.0, cosine = j / 15.0 * (j / 15.0);
      const double expected = charlie_albedo(std::min(cosine, 0.99999), roughness * roughness, 160);
      EXPECT_NEAR(kSheenAlbedo[kSheenSteps * i + j], expected, 0.002) << i << ", " << j;
      last = expected;
    }
  }
  EXPECT_GT(last, 0.1);
}

TEST(FurtherLobesTest, AStretchedHighlightIsLongerAlongTheTangent) {
  // KHR_materials_anisotropy: alpha_t = mix(alpha, 1, strength^2), alpha_b = alpha; Smith's joint visibility.
  Layers layers;
  layers.f0 = {0.9, 0.6, 0.3};
  layers.roughness = 0.4;
  layers.stretch = 0.7;
  expect_response(layers, [&](const glm::dvec3& l, const glm::dvec3& v, const glm::dvec3& h) {
    const double b = 0.16, t = b + (1 - b) * 0.49;
    const double q = h.x * h.x / (t * t) + h.y * h.y / (b * b) + h.z * h.z;
    const double lobe = 1 / (0.5 * kTurn * t * b * q * q);
    const auto masked = [&](const glm::dvec3& w) { return glm::length(glm::dvec3{t * w.x, b * w.y, w.z}); };
    const double visibility = 0.5 / (l.z * masked(v) + v.z * masked(l));
    const double grazing = std::pow(1 - glm::dot(l, h), 5);
    return (layers.f0 + (1.0 - layers.f0) * grazing) * (lobe * visibility);
  });
}

TEST(FurtherLobesTest, NoLayerSendsBackMoreLightThanComes) {
  // Over a white metal, in light from all sides. Midpoints and the table of sheen are within 2 %.
  for (const double cosine : {0.1, 0.3, 0.6, 0.95}) {
    const glm::dvec3 v = towards(cosine, 0.7);
    for (const double roughness : {0.3, 0.6, 1.0}) {
      Layers metal;
      metal.f0 = glm::dvec3{1.0};
      metal.roughness = 0.6;
      Layers coated = metal, fibres = metal, stretched = metal;
      coated.coat = 1;
      coated.coat_roughness = roughness;
      fibres.sheen = glm::dvec3{1.0};
      fibres.sheen_roughness = roughness;
      stretched.roughness = roughness;
      stretched.stretch = 0.8;
      for (const Layers& layers : {coated, fibres, stretched}) {
        EXPECT_LT(Surface(layers, v).furnace(128), 1.02) << cosine << ", roughness " << roughness;
        EXPECT_GT(Surface(layers, v).furnace(128), 0.3) << cosine << ", roughness " << roughness;
      }
    }
  }
}

TEST(FurtherLobesTest, NoHighlightIsNegativeWhereTheNormalLiesBehindTheViewer) {
  // At silhouettes of meshes interpolated normals do, by some ten degrees; half vectors then lie below the
  // surface. A distribution of normals is nowhere negative, however wide a sample of the light makes it.
  Layers plain, coated, stretched;
  coated.coat = 1;
  coated.coat_roughness = plain.roughness = 0.1;
  coated.coat_normal = glm::normalize(glm::dvec3{-0.3, 0, 1});
  stretched.stretch = 0.8;
  stretched.roughness = 0.2;
  bool below = false;
  for (const double height : {-0.5, -0.3, -0.1, 0.0}) {
    const glm::dvec3 v{std::sqrt(1 - height * height), 0, height};
    const std::vector<glm::dvec3> lights = some_directions();
    for (const Layers& layers : {plain, coated, stretched}) {
      const std::vector<glm::dvec3> f = Surface(layers, v).response(lights, 0.3f);
      for (std::size_t i = 0; i < lights.size(); ++i) {
        below = below || (lights[i] + v).z < 0;
        for (int c = 0; c < 3; ++c) ASSERT_GE(f[i][c], 0) << "light " << i << " viewer " << v.z;
      }
    }
  }
  EXPECT_TRUE(below);
}

// Calls check(cosine at the viewer, radiance) for each pixel of a floor in ambient light 1.
template <typename Check>
void look_at_floor(const Material& material, const Check& check) {
  Scene scene;
  test::add(scene, test::floor_quad(50), material);
  scene.ambient = glm::vec3{1.0f};
  const DisplayProfile profile = test::single_view(48, 48, 60, 60);
  const RenderedFrame frame =
      test::render(scene, profile, test::planar_settings(), test::looking_down({0, 2, 0}));
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    check(-test::direction_of_pixel(profile.viewports[0], x, y).z, pixel[0]);
  });
}

TEST(FurtherLobesTest, LightFromAllSidesMeetsCoatSheenAndWhatTheyLeave) {
  // Ambient light 1 meets diffuse albedo + F0 = 0.54 of the base. The coat sends F of it, the base gets the
  // rest; sheen sends its albedo, the base what its strongest channel leaves.
  Material coated = test::matte(glm::vec3{0.5f}), fibres = coated;
  coated.clearcoat.strength = 0.75f;
  look_at_floor(coated, [](double cosine, double radiance) {
    const double coat = 0.75 * schlick(0.04, cosine);
    ASSERT_NEAR(radiance, coat + (1 - coat) * 0.54, 1e-3) << cosine;
  });
  fibres.sheen.colour = glm::vec3{0.6f, 0.8f, 0.1f};
  fibres.sheen.roughness = 0.5f;
  std::vector<double> albedo;
  for (int i = 0; i <= 60; ++i) albedo.push_back(charlie_albedo(std::min(0.3 + i * 0.01, 0.8999), 0.25, 60));
  look_at_floor(fibres, [&](double cosine, double radiance) {
    if (cosine < 0.3 || cosine > 0.89) return;
    const double sheen = albedo[static_cast<std::size_t>(std::lround((cosine - 0.3) * 100))];
    // The nearest hundredth of the cosine is within 0.005 of it, where the albedo falls by less than 1 each.
    ASSERT_NEAR(radiance, 0.6 * sheen + (1 - 0.8 * sheen) * 0.54, 0.015) << cosine;
  });
}

}  // namespace
}  // namespace herr
