// A chart of spheres, roughness 0 ... 1 by metal 0 and 1, in an environment picture and under a box lamp,
// against a slow path tracer.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <thread>

#include "scenes/environment/environment_image.h"
#include "tests/renderer/probes/probe_scenes.h"
#include "tests/renderer/reflectance/slow_gloss.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr double kRoughness[] = {0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1};
// Balls stand far enough apart to see little of one another.
constexpr int kColumns = 9, kWidth = 600, kHeight = 132;
constexpr double kDistance = 35, kApart = 5, kRadius = 0.6;

// A picture of 512 x 256 texels, each the mean over 4 x 4 places of what `radiance` says of a direction.
EnvironmentImage painted(const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
  EnvironmentImage picture;
  picture.width_px = 512;
  picture.height_px = 256;
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      glm::dvec3 sum{0.0};
      for (int sample = 0; sample < 16; ++sample) {
        const double azimuth =
                         ((x + (sample % 4 + 0.5) / 4) / picture.width_px - 0.5) * glm::two_pi<double>(),
                     polar = (y + (sample / 4 + 0.5) / 4) / picture.height_px * glm::pi<double>();
        sum += radiance(
            {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)});
      }
      sum /= 16.0;
      for (int c = 0; c < 3; ++c) picture.rgba.push_back(static_cast<float>(sum[c]));
      picture.rgba.push_back(0);
    }
  }
  return picture;
}

// A sky with clouds over uneven ground, four windows of light in it, and a sun of 8 degrees across, 60 times
// as bright as the sky: a third of all light comes from it.
EnvironmentImage day() {
  const glm::dvec3 sun = glm::normalize(glm::dvec3{0.5, 0.6, 0.6});
  return painted([&](const glm::dvec3& d) {
    const double azimuth = std::atan2(d.x, -d.z);
    const bool sky = d.y > 0;
    glm::dvec3 sum = sky ? glm::dvec3{0.3, 0.4, 0.7} + (1 - d.y) * glm::dvec3{0.6, 0.5, 0.3}
                         : (0.2 + 0.1 * std::sin(6 * d.x) * std::sin(5 * d.z)) * glm::dvec3{1.0, 0.8, 0.5};
    if (sky && d.y < 0.25 && std::sin(7 * azimuth) > 0.3) sum += 0.4;
    if (d.y > 0.5 && d.y < 0.7 && std::abs(std::sin(2 * azimuth)) > 0.95) sum += 3.0;
    if (glm::dot(d, sun) > std::cos(4 / kDegreesPerRadian)) sum += glm::dvec3{60, 54, 45};
    return sum;
  });
}

// A dim room with ten lamps of four to nine degrees across, up to 1250 times as bright as its walls: nine
// tenths of all light come from them.
EnvironmentImage lamps() {
  struct Lamp {
    glm::dvec3 direction;
    double radius_deg, radiance;
  };
  std::vector<Lamp> all;
  for (int i = 0; i < 10; ++i) {
    const double azimuth = 2.4 * i, height = 0.95 - 0.13 * i, across = std::sqrt(1 - height * height);
    all.push_back({{across * std::sin(azimuth), height, -across * std::cos(azimuth)},
                   2.0 + 0.27 * ((7 * i) % 10),
                   150.0 / (1 + i)});
  }
  return painted([&](const glm::dvec3& d) {
    const double wall = 0.12 + 0.05 * d.y + 0.04 * std::sin(5 * d.x) * std::sin(4 * d.z);
    glm::dvec3 sum = wall * glm::dvec3{1.0, 0.9, 0.7};
    for (const Lamp& lamp : all) {
      const double off = glm::dot(d, lamp.direction);
      if (off > std::cos(lamp.radius_deg / kDegreesPerRadian))
        sum += lamp.radiance * glm::dvec3{1, 0.85, 0.6};
    }
    return sum;
  });
}

std::vector<test::GlossBall> chart_balls(int first_row, int rows) {
  std::vector<test::GlossBall> balls;
  for (int row = first_row; row < first_row + rows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      test::GlossBall ball;
      ball.centre = {kApart * (column - 4), kApart * (0.5 - row), -kDistance};
      ball.radius = kRadius;
      ball.metallic = 1 - row;
      ball.roughness = kRoughness[column];
      ball.base = row == 0 ? glm::dvec3{0.95, 0.8, 0.5} : glm::dvec3{0.2, 0.35, 0.5};
      balls.push_back(ball);
    }
  }
  return balls;
}

Scene scene_of(const std::vector<test::GlossBall>& balls) {
  Scene scene;
  for (const test::GlossBall& ball : balls) {
    Instance instance;
    instance.name = "ball";
    instance.kind = ShapeKind::sphere;
    instance.material = static_cast<std::uint32_t>(scene.materials.size());
    instance.world_from_object = {{ball.radius, 0, 0}, {0, ball.radius, 0}, {0, 0, ball.radius}, ball.centre};
    Material material;
    material.base_colour = glm::vec3(ball.base);
    material.metallic = static_cast<float>(ball.metallic);
    material.roughness = static_cast<float>(ball.roughness);
    scene.materials.push_back(material);
    scene.instances.push_back(instance);
  }
  scene.probes.box = Bounds{{-24, -7, -kDistance - 4}, {24, 7, -kDistance + 4}};
  return scene;
}

DisplayProfile chart_view() {
  const double half_width = std::atan(22.5 / kDistance) * kDegreesPerRadian,
               half_height = std::atan(5.0 / kDistance) * kDegreesPerRadian;
  return test::single_view(kWidth, kHeight, half_width, half_height);
}

// Whether the mirrored ray of the pixel along `d` meets another ball. There one ray stands for a lobe, and
// what it meets is no part of the chart.
bool meets_another(const std::vector<test::GlossBall>& balls, const test::GlossBall& ball,
                   const glm::dvec3& d) {
  const double along = glm::dot(ball.centre, d);
  const double inside = along * along - glm::dot(ball.centre, ball.centre) + ball.radius * ball.radius;
  const glm::dvec3 place = d * (along - std::sqrt(inside)), n = glm::normalize(place - ball.centre);
  const glm::dvec3 way = d - 2 * glm::dot(n, d) * n;
  return std::any_of(balls.begin(), balls.end(), [&](const test::GlossBall& other) {
    const glm::dvec3 to = other.centre - place;
    const double ahead = glm::dot(to, way);
    return &other != &ball && ahead > 0 &&
           glm::dot(to, to) - ahead * ahead < 1.1 * other.radius * other.radius;
  });
}

// A pixel whose centre shows a ball, and what the slow tracer says of it: two runs of random numbers.
struct ChartPixel {
  std::size_t ball;
  glm::dvec3 direction, fast;
  std::size_t at;  // in the picture
  glm::dvec3 exact[2];
};

std::vector<ChartPixel> pixels_of(const RenderedFrame& frame, const std::vector<test::GlossBall>& balls) {
  const DisplayProfile profile = chart_view();
  std::vector<ChartPixel> pixels;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, y);
    if ((x + y) % 2 == 1) return;  // half of them tell as much
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const double along = glm::dot(balls[i].centre, d);
      const double off = std::sqrt(glm::dot(balls[i].centre, balls[i].centre) - along * along);
      if (off > 0.995 * balls[i].radius) continue;  // float and double agree on what is hit
      if (meets_another(balls, balls[i], d)) continue;
      pixels.push_back({i, d, {pixel[0], pixel[1], pixel[2]}, static_cast<std::size_t>(y * kWidth + x), {}});
    }
  });
  return pixels;
}

void trace(const test::SlowGloss& slow, std::vector<ChartPixel>& pixels) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < pixels.size(); i = next++) {
      for (std::uint32_t run = 0; run < 2; ++run) {
        pixels[i].exact[run] = slow.radiance(glm::dvec3{0.0}, pixels[i].direction,
                                             2 * static_cast<std::uint32_t>(pixels[i].at) + run);
      }
    }
  };
  std::jthread other(work);
  work();
}

// For someone who looks: a picture of three strips, rendered, slow and four times their difference.
void write_picture(const RenderedFrame& frame, const std::vector<ChartPixel>& pixels,
                   const std::string& name) {
  const char* folder = std::getenv("HERR_TEST_PICTURES");
  if (folder == nullptr) return;
  std::vector<glm::dvec3> fast, slow;
  test::for_each_pixel(frame.viewports[0], [&](int, int, const test::Pixel& pixel) {
    fast.push_back({pixel[0], pixel[1], pixel[2]});
  });
  slow = fast;
  for (const ChartPixel& pixel : pixels) slow[pixel.at] = 0.5 * (pixel.exact[0] + pixel.exact[1]);
  std::ofstream out(std::string(folder) + "/" + name + ".ppm", std::ios::binary);
  out << "P6\n" << kWidth << " " << 3 * kHeight << "\n255\n";
  for (int strip = 0; strip < 3; ++strip) {
    for (std::size_t i = 0; i < fast.size(); ++i) {
      const glm::dvec3 value = strip == 0   ? fast[i]
                               : strip == 1 ? slow[i]
                                            : 4.0 * glm::abs(fast[i] - slow[i]);
      for (int c = 0; c < 3; ++c)
        out.put(static_cast<char>(
            static_cast<unsigned char>(255 * std::pow(std::clamp(value[c], 0.0, 1.0), 1 / 2.2))));
    }
  }
}

double most_of(const test::GlossBall& ball) {
  return ball.roughness <= 0.1 || ball.roughness >= 0.4 ? 0.05 : 0.1;
}

// Root of the mean square difference over the pixels whose centre shows a ball, over the ball's mean. Half
// of what two runs of the slow tracer differ by is how far their mean is off.
void compare(const RenderedFrame& frame, const test::SlowGloss& slow, const std::string& name,
             const std::string& row = "") {
  std::vector<ChartPixel> pixels = pixels_of(frame, slow.balls);
  trace(slow, pixels);
  write_picture(frame, pixels, name + row);
  for (std::size_t i = 0; i < slow.balls.size(); ++i) {
    const test::GlossBall& ball = slow.balls[i];
    double square = 0, between = 0, mean = 0;
    int count = 0;
    for (const ChartPixel& pixel : pixels) {
      if (pixel.ball != i) continue;
      const glm::dvec3 exact = 0.5 * (pixel.exact[0] + pixel.exact[1]), off = pixel.fast - exact,
                       half = 0.5 * (pixel.exact[0] - pixel.exact[1]);
      square += glm::dot(off, off) / 3;
      between += glm::dot(half, half) / 3;
      mean += (exact.x + exact.y + exact.z) / 3;
      ++count;
    }
    const double error = std::sqrt(square * count) / mean, noise = std::sqrt(between * count) / mean;
    std::cout << name << ": metal " << ball.metallic << ", roughness " << ball.roughness << ": mean "
              << mean / count << ", relative RMSE " << error << ", the reference's own " << noise << "\n";
    EXPECT_GT(count, 75);
    EXPECT_LE(noise, 0.01) << name << ", metal " << ball.metallic << ", roughness " << ball.roughness;
    EXPECT_LE(error, most_of(ball)) << name << ", metal " << ball.metallic << ", roughness "
                                    << ball.roughness;
  }
}

// Rays without width meet the middle of pixels, as those of the slow tracer do.
// One row after the other: a ball must not stand between another one and a lamp of the picture.
void expect_chart_in(const EnvironmentImage& picture, const std::string& name) {
  const test::SlowSky sky(picture);
  for (const int row : {0, 1}) {
    test::SlowGloss slow;
    slow.balls = chart_balls(row, 1);
    slow.sky = &sky;
    Scene scene = scene_of(slow.balls);
    scene.environment_map = picture;
    RenderSettings settings = test::probe_settings();
    settings.ray_width = 0;
    test::ProbeRun run(scene, chart_view(), settings, test::sample_from({0, 0, 0}));
    run.run(60);
    compare(run.frame, slow, name, row == 0 ? "-metal" : "-dielectric");
  }
}

TEST(GlossChartTest, SpheresInAPictureOfTheSky) {
  expect_chart_in(day(), "day");
}

TEST(GlossChartTest, SpheresInARoomOfSmallLamps) {
  expect_chart_in(lamps(), "lamps");
}

// A hall at night: half of its light comes from 700 of 524,288 texels, up to 45,000 times as bright as the
// mean. HERR_GLOSS_PICTURE names another picture.
TEST(GlossChartTest, SpheresInAPhotograph) {
  const char *given = std::getenv("HERR_GLOSS_PICTURE"), *folder = std::getenv("HERR_TEST_DATA");
  std::filesystem::path file;
  if (folder != nullptr) file = std::filesystem::path(folder) / "models" / "hdr" / "royal_esplanade_1k.hdr";
  if (given != nullptr) file = given;
  if (!std::filesystem::exists(file)) {
    GTEST_SKIP() << "no picture: HERR_TEST_DATA or HERR_GLOSS_PICTURE names none";
  }
  std::vector<std::string> remarks;
  expect_chart_in(read_environment_image(file, remarks), "picture");
}

TEST(GlossChartTest, SpheresUnderABoxLamp) {
  test::SlowGloss slow;
  slow.balls = chart_balls(0, 2);
  // So large that its highlight is several pixels wide on the smoothest ball.
  slow.lamp = test::light_at({2, 18, -16}, {2000, 1900, 1700}, {12.0f, 3.0f, 12.0f});
  Scene scene = scene_of(slow.balls);
  scene.lights = {*slow.lamp};
  RenderSettings settings = test::probe_settings();
  settings.ray_width = 0;
  settings.light_samples = 1024;
  test::ProbeRun run(scene, chart_view(), settings, test::sample_from({0, 0, 0}));
  run.run(10);
  compare(run.frame, slow, "lamp");
}

}  // namespace
}  // namespace herr
