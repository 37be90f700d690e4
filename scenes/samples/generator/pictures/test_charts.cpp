#include "scenes/samples/generator/pictures/test_charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>
#include <string>

#include "scenes/samples/generator/pictures/text_picture.h"
#include "scenes/samples/generator/shapes/mesh.h"

namespace herr::samples {
namespace {

constexpr int kMargin_px = 96;

constexpr const char* kStory =
    "The eye sees sharply only where it looks. Two degrees from there half of the detail is gone, and at the "
    "border of the field of view a hand is little more than a shadow that moves. A picture that follows the "
    "gaze may leave out what nobody sees, if it leaves it out calmly: what flickers at the edge of sight "
    "draws the eye at once.";

void set_pixel(Picture& page, int x, int y, const glm::ivec3& colour) {
  if (x < 0 || y < 0 || x >= page.width_px || y >= page.height_px) return;
  const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(page.width_px) +
                       static_cast<std::size_t>(x));
  for (int channel = 0; channel < 3; ++channel) {
    page.rgb[at + static_cast<std::size_t>(channel)] = static_cast<std::uint8_t>(colour[channel]);
  }
}

void fill(Picture& page, int x0, int y0, int x1, int y1, const glm::ivec3& colour) {
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) set_pixel(page, x, y, colour);
  }
}

// Writes words into lines between the margins; returns where the next paragraph starts.
int write_paragraph(Picture& page, const std::string& text, int y_px, int size_px) {
  const int widest = page.width_px - 2 * kMargin_px;
  std::istringstream words(text);
  std::string line, word;
  const auto flush = [&] {
    write_line(page, line, kMargin_px, y_px, size_px);
    y_px += size_px * 4 / 3;
    line.clear();
  };
  while (words >> word) {
    const std::string longer = line.empty() ? word : line + " " + word;
    if (line_width_px(longer, size_px) > widest) flush();
    line = line.empty() ? word : line + " " + word;
  }
  flush();
  return y_px + size_px / 2;
}

// The share of black at a pixel, as the mean of 4 x 4 points in it.
template <typename Black>
float share_of_black(const Black& black, float x, float y) {
  int count = 0;
  for (int i = 0; i < 16; ++i) {
    const float dx = (static_cast<float>(i % 4) + 0.5f) / 4.0f,
                dy = (static_cast<float>(i / 4) + 0.5f) / 4.0f;
    count += black(x + dx, y + dy) ? 1 : 0;
  }
  return static_cast<float>(count) / 16.0f;
}

// Draws black and white into a square at (x0, y0); `black` takes pixels from the square's corner.
template <typename Black>
void draw(Picture& page, int x0, int y0, int side_px, const Black& black) {
  for (int y = 0; y < side_px; ++y) {
    for (int x = 0; x < side_px; ++x) {
      const float share = share_of_black(black, static_cast<float>(x), static_cast<float>(y));
      // Half black is half the light: sRGB 188.
      const float srgb = 255.0f * std::pow(1.0f - share, 1.0f / 2.2f);
      set_pixel(page, x0 + x, y0 + y, glm::ivec3(static_cast<int>(std::lround(srgb))));
    }
  }
}

// A curve as a stroke of constant width, drawn from left to right.
template <typename Curve>
void draw_curve(Picture& page, const Curve& curve, float half_width_px, const glm::ivec3& colour) {
  constexpr int kSteps = 16 * kChartSide_px;
  for (int i = 0; i < kSteps; ++i) {
    const float x = kMargin_px + (kChartSide_px - 2 * kMargin_px) * static_cast<float>(i) / kSteps;
    const float y = curve(x);
    const int reach = static_cast<int>(std::ceil(half_width_px));
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        if (static_cast<float>(dx * dx + dy * dy) > half_width_px * half_width_px) continue;
        set_pixel(page, static_cast<int>(x) + dx, static_cast<int>(y) + dy, colour);
      }
    }
  }
}

}  // namespace

Picture reading_page() {
  Picture page = blank_page(kChartSide_px);
  int y_px = kMargin_px + 72;
  for (const int size_px : {72, 52, 38, 26, 18}) y_px = write_paragraph(page, kStory, y_px, size_px);
  return page;
}

Picture letter_chart() {
  constexpr std::array<const char*, 14> kRows{"NCKZO", "RHSDK", "DOVHR", "CZRHS", "ONHRC", "DKSNV", "ZSOKN",
                                              "CKDNR", "SRZKD", "HZOVC", "NVDOK", "VHCNO", "SVHCZ", "OZDVK"};
  Picture page = blank_page(kChartSide_px);
  double size_px = 220, y_px = 320;
  for (const char* row : kRows) {
    const int size = static_cast<int>(std::lround(size_px));
    const double step = 1.6 * size_px;
    double x_px = 0.5 * kChartSide_px - 2.5 * step + 0.3 * size_px;
    for (const char* letter = row; *letter != '\0'; ++letter) {
      write_line(page, std::string(1, *letter), static_cast<int>(x_px), static_cast<int>(y_px), size);
      x_px += step;
    }
    size_px *= std::pow(10.0, -0.1);
    y_px += 1.35 * size_px;
  }
  return page;
}

Picture line_chart() {
  Picture page = blank_page(kChartSide_px);
  constexpr int kDivisions = 12;
  constexpr int kSpan = kChartSide_px - 2 * kMargin_px;
  for (int i = 0; i <= kDivisions; ++i) {
    const int at = kMargin_px + kSpan * i / kDivisions;
    const int thick = i == 0 || i == kDivisions ? 6 : 2;
    fill(page, at, kMargin_px, at + thick, kChartSide_px - kMargin_px, glm::ivec3(150));
    fill(page, kMargin_px, at, kChartSide_px - kMargin_px, at + thick, glm::ivec3(150));
    write_line(page, std::to_string(5 * i), at - 16, kChartSide_px - kMargin_px + 52, 40);
    write_line(page, std::to_string(200 - 10 * i), 12, at + 14, 40);
  }
  write_line(page, "pixels per degree against degrees from the gaze", 480, 70, 52);
  const auto share = [](float x) { return (x - kMargin_px) / kSpan; };
  const auto row = [](float value) { return kMargin_px + kSpan * (1.0f - value); };
  // The paper's acuity 200 / (theta + 1) over 60 degrees; a chirp; a sum of incommensurate waves.
  draw_curve(page, [&](float x) { return row(1.0f / (60.0f * share(x) + 1.0f)); }, 3.0f, {190, 30, 30});
  draw_curve(page, [&](float x) { return row(0.5f + 0.2f * std::sin(260.0f * share(x) * share(x))); }, 2.0f,
             {30, 60, 190});
  draw_curve(page,
             [&](float x) {
               const float t = share(x);
               return row(0.75f + 0.1f * std::sin(23.0f * t) + 0.06f * std::sin(61.0f * t + 1.0f));
             },
             2.0f, {20, 120, 40});
  return page;
}

Picture resolution_chart() {
  Picture page = blank_page(kChartSide_px);
  constexpr int kSquare = kChartSide_px / 2 - 2 * kMargin_px;
  constexpr float kMiddle = 0.5f * kSquare;
  draw(page, kMargin_px, kMargin_px, kSquare, [](float x, float y) {
    const glm::vec2 d(x - kMiddle, y - kMiddle);
    if (glm::length(d) > kMiddle) return false;
    return std::fmod(std::atan2(d.y, d.x) + kPi, 2.0f * kPi / 36.0f) < kPi / 36.0f;
  });
  draw(page, kChartSide_px / 2 + kMargin_px, kMargin_px, kSquare, [](float x, float y) {
    const glm::vec2 d(x - kMiddle, y - kMiddle);
    if (glm::length(d) > kMiddle) return false;
    // The period falls from the middle outwards to 4 pixels at the rim.
    return std::sin(kPi * glm::dot(d, d) / (4.0f * kMiddle)) > 0.0f;
  });
  constexpr int kBand = kSquare / 5;
  for (int i = 0; i < 5; ++i) {
    const float period_px = static_cast<float>(2 << i);
    const auto lies = [&](float along) { return std::fmod(along, period_px) < 0.5f * period_px; };
    const int y0 = kChartSide_px / 2 + i * kBand;
    draw(page, kMargin_px, y0, kBand, [&](float x, float) { return lies(x); });
    draw(page, kMargin_px + kBand + 20, y0, kBand, [&](float, float y) { return lies(y); });
    write_line(page, std::to_string(2 << i), kMargin_px + 2 * kBand + 60, y0 + kBand / 2, 64);
  }
  return page;
}

}  // namespace herr::samples
