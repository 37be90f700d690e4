// Spheres and boxes in whole frames: light, shadows and glass on them, at any size and place.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

void add_shape(Scene& scene, ShapeKind kind, const Material& material, const glm::dvec3& centre,
               const glm::dvec3& half) {
  Instance instance;
  instance.name = "shape";
  instance.kind = kind;
  instance.material = static_cast<std::uint32_t>(scene.materials.size());
  instance.world_from_object = {{half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}, centre};
  scene.materials.push_back(material);
  scene.instances.push_back(instance);
}

RenderedFrame look(const Scene& scene, const glm::dvec3& head, double half_width_deg = 25) {
  return test::render(scene, test::single_view(96, 96, half_width_deg, half_width_deg),
                      test::planar_settings(), test::sample_from(head));
}

// Largest difference of two pictures, relative to 1 or the value.
double difference(const RenderedFrame& a, const RenderedFrame& b) {
  std::vector<double> values;
  test::for_each_pixel(a.viewports[0], [&](int, int, const test::Pixel& p) {
    values.insert(values.end(), p.begin(), p.end());
  });
  double largest = 0;
  std::size_t at = 0;
  test::for_each_pixel(b.viewports[0], [&](int, int, const test::Pixel& p) {
    for (const double value : p) {
      const double other = values[at++];
      largest = std::max(largest, std::abs(value - other) / std::max(1.0, std::abs(other)));
    }
  });
  return largest;
}

// A ball and a box before a wall that is a box too, lit from beside the eye, all scaled about the head.
Scene group(double scale, const glm::dvec3& head) {
  Scene scene;
  add_shape(scene, ShapeKind::sphere, test::matte({0.8f, 0.3f, 0.2f}), head + scale * glm::dvec3{-0.5, 0, -3},
            glm::dvec3{0.6 * scale});
  add_shape(scene, ShapeKind::box, test::matte({0.2f, 0.5f, 0.7f}), head + scale * glm::dvec3{0.8, -0.2, -3},
            scale * glm::dvec3{0.4, 0.5, 0.3});
  add_shape(scene, ShapeKind::box, test::matte(glm::vec3{0.6f}), head + scale * glm::dvec3{0, 0, -5},
            scale * glm::dvec3{6, 6, 0.5});
  const auto intensity = static_cast<float>(12 * scale * scale);
  scene.lights = {test::light_at(head + scale * glm::dvec3{1, 1.5, 0}, glm::vec3{intensity})};
  return scene;
}

TEST(ShapePicturesTest, APictureDoesNotDependOnTheScaleOfItsScene) {
  const RenderedFrame metres = look(group(1, {0, 0, 0}), {0, 0, 0});
  test::expect_finite(metres);
  for (const double scale : {1e-4, 1e-2, 1e3, 1e5}) {
    const RenderedFrame scaled = look(group(scale, {0, 0, 0}), {0, 0, 0});
    test::expect_finite(scaled);
    EXPECT_EQ(scaled.counters.invalid_rays, 0);
    int differing = 0;
    std::vector<test::Pixel> pixels;
    test::for_each_pixel(metres.viewports[0], [&](int, int, const test::Pixel& p) { pixels.push_back(p); });
    std::size_t at = 0;
    test::for_each_pixel(scaled.viewports[0], [&](int, int, const test::Pixel& p) {
      differing += std::abs(p[0] - pixels[at++][0]) > 2e-3;
    });
    // Only on the borders of shapes and shadows may a pixel fall to the other side: of about 500 such pixels
    // a rounding of 1e-6 relative to a pixel of 9e-3 moves next to none. Secondary rays start up to 3e-6 m
    // higher on the smallest, which is 3 % of its size: its contact shadows differ.
    EXPECT_LE(differing, scale < 1e-3 ? 200 : 10) << "scale " << scale;
  }
}

TEST(ShapePicturesTest, FarFromTheOriginLooksAsAtTheOrigin) {
  const RenderedFrame here = look(group(1, {0, 0, 0}), {0, 0, 0});
  const glm::dvec3 there{1e6 * 16, -512, 1e5 * 16};  // where the anchor stands exactly on the head
  EXPECT_LT(difference(look(group(1, there), there), here), 1e-3);
}

TEST(ShapePicturesTest, ALargeBallIsAFloorWithoutAcne) {
  // Radius 100 km, the eye 2 m above it: from there the ball is a plane but for 2 / 1e5 of slope. Its points
  // are known to 1e5 * 2^-20 = 0.1 m, where shadow rays start. No pixel may be dark, and the light falls off
  // as on a plane: the light is 50 m up, so 0.1 m is 0.4 %; half a percent for both.
  Scene ball, plane;
  add_shape(ball, ShapeKind::sphere, test::matte(glm::vec3{0.5f}), {0, -1e5, 0}, glm::dvec3{1e5});
  test::add(plane, test::floor_quad(1000), test::matte(glm::vec3{0.5f}));
  for (Scene* scene : {&ball, &plane}) scene->lights = {test::light_at({5, 50, 3}, glm::vec3{4000.0f})};
  const DisplayProfile profile = test::single_view(64, 64, 40, 40);
  const FrameSample down = test::looking_down({0, 2, 0});
  const RenderedFrame a = test::render(ball, profile, test::planar_settings(), down);
  const RenderedFrame b = test::render(plane, profile, test::planar_settings(), down);
  double darkest = 1e9;
  test::for_each_pixel(a.viewports[0],
                       [&](int, int, const test::Pixel& p) { darkest = std::min(darkest, p[0]); });
  EXPECT_GT(darkest, 0.1);
  EXPECT_LT(difference(a, b), 5e-3);
}

TEST(ShapePicturesTest, FromWithinABallItsWallIsLitEvenly) {
  // A light in the middle of a matte ball: the same distance and angle everywhere.
  // Half-float pixels have 11 bits.
  Scene scene;
  add_shape(scene, ShapeKind::sphere, test::matte(glm::vec3{0.5f}), {0, 0, 0}, glm::dvec3{2.0});
  scene.lights = {test::light_at({0, 0, 0}, glm::vec3{10.0f})};
  const RenderedFrame frame = look(scene, {0, 0, 0});
  double low = 1e9, high = 0;
  test::for_each_pixel(frame.viewports[0], [&](int, int, const test::Pixel& p) {
    low = std::min(low, p[0]);
    high = std::max(high, p[0]);
  });
  // Diffuse alone: 10 / 4 * 0.5 / pi = 0.398; the dielectric's highlight adds a little.
  EXPECT_GT(low, 0.39);
  EXPECT_LT(high, 0.45);
  EXPECT_LT((high - low) / high, 2e-3);
}

// Where a ray from the origin leaves the unit ball about (0, 0, -4), refracted twice by Snell's law: the
// angle to the normal is the same at both ends of the chord, and the ray turns twice by the difference.
glm::dvec3 through_ball(const glm::dvec3& d, double index, glm::dvec3& leaves_at, double& cosine) {
  const glm::dvec3 o{0, 0, 4};  // the eye, about the ball's centre
  const double b = -glm::dot(o, d), half = std::sqrt(b * b - glm::dot(o, o) + 1);
  const glm::dvec3 p = o + (b - half) * d, n = glm::normalize(p);
  cosine = -glm::dot(n, d);
  const auto bend = [](const glm::dvec3& v, const glm::dvec3& normal, double eta) {
    const double c = -glm::dot(v, normal), below = std::sqrt(1 - eta * eta * (1 - c * c));
    return eta * v + (eta * c - below) * normal;
  };
  const glm::dvec3 inside = bend(d, n, 1 / index);
  leaves_at = p - 2 * glm::dot(p, inside) * inside;
  return bend(inside, -glm::normalize(leaves_at), index);
}

TEST(ShapePicturesTest, AGlassBallRefractsAsSnellSays) {
  // Before a half plane that glows for x > 0.1, 3 m behind the ball.
  constexpr double kIndex = 1.5;
  Scene scene;
  Material glass = test::matte(glm::vec3{1.0f});
  glass.roughness = 0, glass.transmission = 1, glass.refractive_index = kIndex;
  add_shape(scene, ShapeKind::sphere, glass, {0, 0, -4}, glm::dvec3{1.0});
  test::add(scene, test::quad({0.1f, -50, -7}, {50, 0, 0}, {0, 100, 0}), test::glowing({1, 1, 1}));
  RenderSettings settings = test::planar_settings();
  settings.reflections = false;
  const DisplayProfile profile = test::single_view(201, 201, 14, 14);
  const RenderedFrame frame = test::render(scene, profile, settings, test::sample_from({0, 0, 0}));
  int bright = 0, dark = 0, undecided = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, y);
    // Well within the limb at sin = 1/4: beyond an angle of incidence of 80 degrees a float's rounding shows.
    if (std::sqrt(d.x * d.x + d.y * d.y) > 0.25 * std::sin(80 / kDegreesPerRadian)) return;
    glm::dvec3 from{0.0};
    double cosine = 0;
    const glm::dvec3 way = through_ball(d, kIndex, from, cosine);
    const double x_behind = from.x + way.x * (-3 - from.z) / way.z - 0.1;
    if (std::abs(x_behind) < 1e-3) {
      ++undecided;
      return;
    }
    // Fresnel's equations, unpolarised; the same at both surfaces, since the angles are.
    const double below = std::sqrt(1 - (1 - cosine * cosine) / (kIndex * kIndex));
    const double across = (cosine - kIndex * below) / (cosine + kIndex * below),
                 along = (below - kIndex * cosine) / (below + kIndex * cosine);
    const double passes = 1 - 0.5 * (across * across + along * along);
    const double expected = x_behind > 0 ? passes * passes : 0;
    ++(x_behind > 0 ? bright : dark);
    ASSERT_NEAR(pixel[0], expected, 2e-3) << x << ", " << y << ", off the edge by " << x_behind;
  });
  std::cout << bright << " bright, " << dark << " dark, " << undecided << " at the edge\n";
  EXPECT_GT(bright, 5000);
  EXPECT_GT(dark, 5000);
  EXPECT_LT(undecided, 200);
}

TEST(ShapePicturesTest, ABallCastsTheShadowOfABall) {
  // A ball of radius 0.5 at 1 m under a point light at 3 m: on the floor the shadow's radius is 3 tan(asin(
  // 0.5 / 2)) = 0.7746 m about the foot of the light.
  Scene scene;
  add_shape(scene, ShapeKind::sphere, test::matte(glm::vec3{0.5f}), {0, 1, -4}, glm::dvec3{0.5});
  test::add(scene, test::floor_quad(20), test::matte(glm::vec3{0.5f}));
  scene.lights = {test::light_at({0, 3, -4}, glm::vec3{20.0f})};
  const DisplayProfile profile = test::single_view(301, 301, 20, 20);
  const RenderedFrame frame =
      test::render(scene, profile, test::planar_settings(), test::looking_down({1.4, 4.5, -4}));
  int lit = 0, shadowed = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, y);
    const glm::dvec3 way{d.x, d.z, -d.y};  // looking down: -Z of the view is -Y of the world
    const glm::dvec3 eye{1.4, 4.5, -4}, floor = eye - way * (eye.y / way.y);
    const glm::dvec3 to_ball = glm::dvec3{0, 1, -4} - eye;
    const double along = glm::dot(to_ball, way);
    if (glm::dot(to_ball, to_ball) - along * along < 0.26) return;  // the ball itself is in the way
    const double off = std::hypot(floor.x, floor.z + 4) - 0.774597;
    if (std::abs(off) < 2e-3) return;
    ++(off > 0 ? lit : shadowed);
    ASSERT_EQ(pixel[0] > 0, off > 0) << x << ", " << y << ", off the shadow's edge by " << off;
  });
  std::cout << lit << " lit, " << shadowed << " shadowed\n";
  EXPECT_GT(lit, 10000);
  EXPECT_GT(shadowed, 1000);
}

TEST(ShapePicturesTest, ASceneWithoutShapesPlansNone) {
  Scene scene;
  test::add(scene, test::floor_quad(1), test::matte(glm::vec3{0.5f}));
  EXPECT_FALSE(plan_frame(scene, test::small_settings(), false).shapes);
  add_shape(scene, ShapeKind::box, test::matte(glm::vec3{0.5f}), {0, 1, 0}, glm::dvec3{0.5});
  const FramePlan plan = plan_frame(scene, test::small_settings(), false);
  EXPECT_TRUE(plan.shapes);
  const auto entry = std::find_if(plan.entries.begin(), plan.entries.end(),
                                  [](const PlanEntry& e) { return e.name == "analytic shapes"; });
  ASSERT_NE(entry, plan.entries.end());
  EXPECT_EQ(entry->reason, "1 of 2 instances are spheres or boxes");
}

}  // namespace
}  // namespace herr
