// Inputs at the end of their range: nothing aborts, no NaN leaves, and far from the origin is like at it.
#include <gtest/gtest.h>

#include <limits>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Scene sphere_on_floor(const Material& material = test::matte(glm::vec3{0.5f})) {
  Scene scene;
  test::add(scene, test::floor_quad(20, -1), test::matte({0.5f, 0.4f, 0.3f}));
  test::add(scene, test::sphere({0, 0, -3}, 1), material);
  scene.lights = {test::light_at({1, 3, -1}, glm::vec3{20.0f}, {0.5f, 0.25f, 0.5f})};
  scene.ambient = scene.environment = glm::vec3{0.25f};
  return scene;
}

RenderedFrame render_small(const Scene& scene, const FrameSample& sample = test::sample_from({0, 0, 0}),
                           int light_samples = 4) {
  RenderSettings settings = test::small_settings();
  settings.light_samples = light_samples;
  return test::render(scene, test::small_profile(), settings, sample);
}

void expect_sound(const RenderedFrame& frame) {
  test::expect_finite(frame);
  test::expect_times_add_up(frame);
  EXPECT_EQ(frame.counters.invalid_rays, 0);
  EXPECT_EQ(frame.counters.rays[RayKind::primary], frame.counters.polar_samples);
}

TEST(ExtremeCasesTest, AHeadPoseThatIsNoPoseIsRefused) {
  const Scene scene = sphere_on_floor();
  for (const glm::dvec3& position :
       {glm::dvec3{kNaN, 0, 0}, {0, kInfinity, 0}, {0, 0, -kInfinity}, {2e9, 0, 0}}) {
    EXPECT_THROW(render_small(scene, test::sample_from(position)), std::invalid_argument);
  }
  for (const glm::dquat& turn : {glm::dquat(kNaN, 0, 0, 0), glm::dquat(0, 0, 0, 0), glm::dquat(2, 0, 0, 0),
                                 glm::dquat(1, 0, kInfinity, 0)}) {
    FrameSample sample = test::sample_from({0, 0, 0});
    sample.head.world_from_head.orientation = turn;
    EXPECT_THROW(render_small(scene, sample), std::invalid_argument);
  }
}

TEST(ExtremeCasesTest, SettingsOutOfRangeAreRefused) {
  const Scene scene = sphere_on_floor();
  const auto refuse = [&](const std::function<void(RenderSettings&)>& spoil) {
    RenderSettings settings = test::small_settings();
    spoil(settings);
    EXPECT_THROW(Renderer(scene, test::small_profile(), settings, false), std::invalid_argument);
  };
  refuse([](RenderSettings& s) { s.polar_width = 0; });
  refuse([](RenderSettings& s) { s.polar_width = 8193; });
  refuse([](RenderSettings& s) { s.polar_height = 0; });
  refuse([](RenderSettings& s) { s.polar_height = 49; });
  refuse([](RenderSettings& s) { s.light_samples = 0; });
  refuse([](RenderSettings& s) { s.light_samples = 4097; });
  refuse([](RenderSettings& s) { s.threads = -1; });
  refuse([](RenderSettings& s) { s.threads = 513; });
  refuse([](RenderSettings& s) { s.feed_distance_m = 0; });
  refuse([](RenderSettings& s) { s.feed_distance_m = kNaN; });
}

TEST(ExtremeCasesTest, AGazeThatIsNoDirectionLooksStraightAhead) {
  const Scene scene = sphere_on_floor();
  const RenderedFrame ahead = render_small(scene);
  for (const glm::dvec3& gaze : {glm::dvec3{kNaN, 0, -1}, {0, 0, 0}, {kInfinity, 0, 0}}) {
    const RenderedFrame frame = render_small(scene, test::sample_from({0, 0, 0}, gaze));
    expect_sound(frame);
    test::expect_same_bits(ahead, frame);
  }
}

TEST(ExtremeCasesTest, AGazeThatJumpsEveryFrameIsFine) {
  const Scene scene = sphere_on_floor();
  Renderer renderer(scene, test::small_profile(), test::small_settings(), false);
  RenderedFrame frame;
  for (int i = 0; i < 50; ++i) {
    test::render_with(renderer, scene, test::sample_from({0, 0, 0}, test::gaze_deg(137.5 * i, 61.8 * i)),
                      frame);
    expect_sound(frame);
  }
}

TEST(ExtremeCasesTest, AnEmptySceneShowsTheEnvironment) {
  Scene scene;
  scene.environment = {0.25f, 0.5f, 1};
  const RenderedFrame frame = render_small(scene);
  expect_sound(frame);
  test::for_each_pixel(frame.viewports[1], [](int, int, const test::Pixel& pixel) {
    ASSERT_EQ(pixel, (test::Pixel{0.25, 0.5, 1, 1}));
  });
}

TEST(ExtremeCasesTest, DegenerateAndDuplicateTrianglesDoNotHarmTheRest) {
  Scene scene = sphere_on_floor();
  TriangleMesh& mesh = scene.meshes[1];
  const auto n = static_cast<std::uint32_t>(mesh.triangles.size());
  for (std::uint32_t i = 0; i < n; i += 3) mesh.triangles.push_back(mesh.triangles[i]);  // duplicates
  for (std::uint32_t i = 0; i + 2 < mesh.positions.size(); i += 5) {
    mesh.triangles.push_back({i, i, i});          // points
    mesh.triangles.push_back({i, i + 1, i + 1});  // lines
  }
  // Slivers: three corners on a line, nearly.
  mesh.positions.insert(mesh.positions.end(), {{-1, 1, -2}, {1, 1, -2}, {0, 1.0000001f, -2}});
  mesh.normals.insert(mesh.normals.end(), 3, {0, 0, 1});
  mesh.uvs.insert(mesh.uvs.end(), 3, {0, 0});
  const auto last = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.triangles.push_back({last - 3, last - 2, last - 1});
  expect_sound(render_small(scene));

  Scene only_degenerate;
  TriangleMesh points;
  points.positions.assign(3, {0, 0, -2});
  points.normals.assign(3, {0, 0, 1});
  points.triangles = {{0, 1, 2}};
  test::add(only_degenerate, points, test::matte(glm::vec3{0.5f}));
  expect_sound(render_small(only_degenerate));
}

TEST(ExtremeCasesTest, MeshesWithoutTrianglesAreNothing) {
  Scene scene = sphere_on_floor();
  test::add(scene, TriangleMesh{}, test::matte(glm::vec3{0.5f}));
  const RenderedFrame frame = render_small(scene);
  expect_sound(frame);
  test::expect_same_bits(render_small(sphere_on_floor()), frame);
}

TEST(ExtremeCasesTest, NormalsOfNoLengthDoNotHarmTheRest) {
  Scene scene = sphere_on_floor();
  for (std::size_t i = 0; i < scene.meshes[1].normals.size(); i += 2)
    scene.meshes[1].normals[i] = glm::vec3{0.0f};
  expect_sound(render_small(scene));
}

// The same scene `scale` times as large, as far away, lit as brightly.
Scene scaled(float scale) {
  Scene scene;
  test::add(scene, test::floor_quad(20 * scale, -scale), test::matte({0.5f, 0.4f, 0.3f}));
  test::add(scene, test::sphere({0, 0, -3 * scale}, scale), test::matte(glm::vec3{0.5f}));
  scene.lights = {test::light_at(glm::dvec3{1, 3, -1} * double{scale}, glm::vec3{20 * scale * scale},
                                 glm::vec3{0.5f, 0.25f, 0.5f} * scale)};
  scene.ambient = scene.environment = glm::vec3{0.25f};
  return scene;
}

TEST(ExtremeCasesTest, HugeScenesLookLikeSmallOnes) {
  const RenderedFrame one = render_small(scaled(1));
  // A power of two: every float is scaled exactly, but for the offsets of secondary rays.
  for (const float scale : {131072.0f, 0x1p-3f}) {
    SCOPED_TRACE(scale);
    const RenderedFrame frame = render_small(scaled(scale));
    expect_sound(frame);
    int differ = 0, pixels = 0;
    test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
      const test::Pixel other = test::pixel_at(one.viewports[0], x, y);
      differ += std::abs(pixel[0] - other[0]) > 0.02 * other[0];
      ++pixels;
    });
    // Shadow edges may move by the offset, 2^-16 of the distance: less than a sample, so few pixels differ.
    EXPECT_LT(differ, pixels / 100);
  }
}

TEST(ExtremeCasesTest, TinyScenesAreSound) {
  // 1e-4: a sphere of a tenth of a millimetre.
  const RenderedFrame frame = render_small(scaled(1e-4f));
  expect_sound(frame);
  // The sphere still hides the background.
  EXPECT_NE(test::pixel_at(frame.viewports[0], 32, 32)[0], 0.25);
}

TEST(ExtremeCasesTest, AMillionMetresAwayIsByteForByteLikeTheOrigin) {
  // The anchor is a multiple of 16 m; the head's place and all of the scene's are
  // dyadic, so that nothing rounds.
  const Scene near = sphere_on_floor();
  const FrameSample near_sample = test::sample_from({0.25, 0.125, 0.5}, test::gaze_deg(7, -3));
  const RenderedFrame expected = render_small(near, near_sample);
  for (const glm::dvec3& away :
       {glm::dvec3{1e6, 0, 0}, {-1e6, 1e6, 1e6}, {16, -16, 160}, {0, 0, 16.0 * 4194304}}) {
    SCOPED_TRACE(testing::Message() << away.x << " " << away.y << " " << away.z);
    Scene far = near;
    for (Instance& instance : far.instances) instance.world_from_object[3] += away;
    for (AreaLight& light : far.lights) light.centre += away;
    FrameSample sample = near_sample;
    sample.head.world_from_head.position += away;
    test::expect_same_bits(expected, render_small(far, sample));
    // The same by standing the recording elsewhere in the scene.
    far.world_from_session.position = away;
    test::expect_same_bits(expected, render_small(far, near_sample));
  }
}

TEST(ExtremeCasesTest, TheAnchorFollowsTheHeadAndCommitsOnlyThen) {
  const Scene scene = sphere_on_floor();
  Renderer renderer(scene, test::small_profile(), test::small_settings(), false);
  RenderedFrame frame;
  const auto commits_at = [&](const glm::dvec3& head) {
    test::render_with(renderer, scene, test::sample_from(head), frame);
    return frame.counters.commits;
  };
  EXPECT_EQ(commits_at({0, 0, 0}), 1);
  EXPECT_EQ(commits_at({0, 0, 0}), 0);
  EXPECT_EQ(commits_at({23.9, 0, 0}), 0);
  EXPECT_EQ(commits_at({24.1, 0, 0}), 1);  // now at x = 32 (24.1 / 16 rounds to 2)
  EXPECT_EQ(commits_at({9, 0, 0}), 0);
  EXPECT_EQ(commits_at({1e8, 0, 0}), 1);
}

TEST(ExtremeCasesTest, AlbedoAndRoughnessAtBothEndsStayFinite) {
  for (const float albedo : {0.0f, 1.0f}) {
    for (const float roughness : {0.0f, 1.0f}) {
      for (const float metallic : {0.0f, 1.0f}) {
        for (const float mirror : {0.0f, 1.0f}) {
          SCOPED_TRACE(testing::Message() << albedo << " " << roughness << " " << metallic << " " << mirror);
          Material material = test::matte(glm::vec3{albedo});
          material.roughness = roughness;
          material.metallic = metallic;
          material.mirror = mirror;
          const RenderedFrame frame = render_small(sphere_on_floor(material));
          expect_sound(frame);
        }
      }
    }
  }
}

TEST(ExtremeCasesTest, LightTooBrightForHalfIsClampedNotInfinite) {
  Scene scene = sphere_on_floor();
  scene.lights[0].intensity_w_sr = glm::vec3{1e30f};
  const RenderedFrame frame = render_small(scene);
  expect_sound(frame);
  double brightest = 0;
  test::for_each_pixel(frame.viewports[0], [&](int, int, const test::Pixel& pixel) {
    brightest = std::max(brightest, pixel[0]);
  });
  EXPECT_EQ(brightest, 65504.0);
}

TEST(ExtremeCasesTest, TransformsThatCannotBeInvertedAreRefused) {
  const auto refuse = [](const glm::dmat4x3& place) {
    Scene scene;
    test::add(scene, test::floor_quad(1), test::matte(glm::vec3{0.5f}), false, place);
    EXPECT_THROW(Renderer(scene, test::small_profile(), test::small_settings(), false),
                 std::invalid_argument);
  };
  glm::dmat4x3 flat{1.0}, broken{1.0}, far{1.0};
  flat[1] = glm::dvec3{0.0};
  broken[3].x = kNaN;
  far[3].x = 1e300;
  refuse(flat);
  refuse(broken);
  refuse(far);
}

TEST(ExtremeCasesTest, AMirrorImageOfAnInstanceIsLitOnItsOuterSide) {
  // Scale -1 on an axis turns the winding round; a symmetric scene must look the same.
  const Scene plain = sphere_on_floor();
  Scene turned = plain;
  turned.instances[1].world_from_object[0] = {-1, 0, 0};
  const RenderedFrame a = render_small(plain), b = render_small(turned);
  expect_sound(b);
  int differ = 0;
  test::for_each_pixel(a.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    differ += std::abs(pixel[0] - test::pixel_at(b.viewports[0], x, y)[0]) > 0.02;
  });
  // The sphere's facets are symmetric but for the last digit of their corners: edges only.
  EXPECT_LT(differ, 64 * 64 / 100);
}

TEST(ExtremeCasesTest, StageTimesAddUpToTheFrameTime) {
  Scene scene = sphere_on_floor();
  scene.materials[1].mirror = 0.5f;
  for (const int threads : {1, 2, 4}) {
    RenderSettings settings = test::small_settings();
    settings.threads = threads;
    const RenderedFrame frame =
        test::render(scene, test::small_profile(), settings, test::sample_from({0, 0, 0}));
    test::expect_times_add_up(frame);
    EXPECT_GT(frame.times[Stage::first_hits], 0.0);
    EXPECT_GT(frame.times[Stage::viewports], 0.0);
  }
}

}  // namespace
}  // namespace herr
