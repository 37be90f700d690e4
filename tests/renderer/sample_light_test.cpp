// Light samples that are spent only where they disagree, on whole frames of the generated sample scene: what
// they save and what they cost.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>

#include "tests/paths.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// Root mean square of the difference of all colour values of all viewports, linear, over their mean: exposed
// so that the average of the reference is 1.
double relative_rms(const RenderedFrame& reference, const RenderedFrame& other) {
  double square = 0, sum = 0, count = 0;
  for (std::size_t i = 0; i < reference.viewports.size(); ++i) {
    const ViewportImage& with = other.viewports[i];
    test::for_each_pixel(reference.viewports[i], [&](int x, int y, const test::Pixel& a) {
      const test::Pixel b = test::pixel_at(with, x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        square += (a[c] - b[c]) * (a[c] - b[c]);
        sum += a[c];
        ++count;
      }
    });
  }
  return std::sqrt(square / count) / (sum / count);
}

std::int64_t all_shadow_rays(const RayCounts& rays) {
  return rays[RayKind::shadow] + rays[RayKind::catcher_shadow] + rays[RayKind::mirror_shadow];
}

TEST(SampleLightTest, AdaptiveSamplesOfTheGeneralSceneTraceAThirdOfTheRays) {
  const std::filesystem::path source = test::source_dir();
  if (!std::filesystem::exists(source / "scenes/samples/generated/teapot.glb")) {
    GTEST_SKIP() << "scenes/samples/generated is missing; an ordinary build makes it";
  }
  const Scene scene = load_scene(source / "scenes/samples/general.scene.json");
  Session session = Session::open(source / "sessions/samples/desk-walk");
  RenderSettings settings;  // 1576 x 768 for both eyes together
  settings.light_samples = 64;
  Renderer plain(scene, xr1_half_profile(), settings, true);
  settings.first_light_samples = 4;
  Renderer adaptive(scene, xr1_half_profile(), settings, true);
  RenderedFrame all, some;
  for (const double at_s : {0.5, 1.5}) {
    const FrameSample sample = session.sample(session.start_ns() + static_cast<TimeNs>(at_s * 1e9));
    test::render_with(plain, scene, sample, all);
    test::render_with(adaptive, scene, sample, some);
    const auto times_fewer = [](std::int64_t a, std::int64_t b) {
      return static_cast<double>(a) / static_cast<double>(b);
    };
    const double first = times_fewer(all.counters.rays[RayKind::shadow], some.counters.rays[RayKind::shadow]);
    const double every = times_fewer(all_shadow_rays(all.counters.rays), all_shadow_rays(some.counters.rays));
    const double rms = relative_rms(all, some);
    for (std::size_t k = 0; k < kRayKinds; ++k) {
      std::cout << name_of(static_cast<RayKind>(k)) << " " << all.counters.rays.of_kind[k] << " "
                << some.counters.rays.of_kind[k] << "\n";
    }
    std::cout << "at " << at_s << " s: " << first << " times fewer at first hits, " << every
              << " times fewer of all kinds, RMS difference " << rms << " of the mean\n";
    EXPECT_GE(every, 3);
    EXPECT_LE(rms, 0.002);
  }
}

}  // namespace
}  // namespace herr
