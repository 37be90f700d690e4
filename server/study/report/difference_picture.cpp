#include "server/study/report/difference_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "server/output/png_encoder.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr int kPanelGap_px = 4;
constexpr int kPicturePngLevel = 6;  // the picture is part of two files: size before speed

using Pixel = std::array<std::uint8_t, 3>;

std::uint8_t unit8_of(double value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

// Black, red, yellow, white at 0, 1/3, 2/3, 1.
Pixel black_body(double value) {
  const double x = 3 * std::clamp(value, 0.0, 1.0);
  return {unit8_of(x), unit8_of(x - 1), unit8_of(x - 2)};
}

std::uint8_t srgb8_of(double linear) {
  return unit8_of(std::isnan(linear) ? 0 : srgb_from_linear(linear));
}

// Mean of value(i) over the pixels i of one box; boxes at the right and lower edge may be cut.
template <typename Value>
double box_mean(const LinearPicture& picture, int box, int column, int row, const Value& value) {
  const int right = std::min((column + 1) * box, picture.width_px);
  const int bottom = std::min((row + 1) * box, picture.height_px);
  double sum = 0;
  for (int y = row * box; y < bottom; ++y) {
    for (int x = column * box; x < right; ++x) {
      sum += value(static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) +
                   static_cast<std::size_t>(x));
    }
  }
  return sum / (double(right - column * box) * (bottom - row * box));
}

Pixel colour_of(const LinearPicture& picture, int box, int column, int row) {
  Pixel pixel{};
  for (std::size_t c = 0; c < 3; ++c) {
    pixel[c] = srgb8_of(box_mean(picture, box, column, row,
                                 [&](std::size_t i) { return static_cast<double>(picture.plane[c][i]); }));
  }
  return pixel;
}

// What is no number differs by all there is.
double difference_at(const LinearPicture& test, const LinearPicture& reference, std::size_t i) {
  double largest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double difference = std::abs(double(test.plane[c][i]) - double(reference.plane[c][i]));
    largest = std::max(largest, std::isfinite(difference) ? difference : 1.0);
  }
  return largest;
}

void check_pictures(const LinearPicture& test, const LinearPicture& reference, double gain, int panel_px) {
  if (test.width_px != reference.width_px || test.height_px != reference.height_px || test.width_px < 1 ||
      test.height_px < 1) {
    throw std::invalid_argument("difference_picture: pictures of two sizes, or empty ones");
  }
  for (const LinearPicture* picture : {&test, &reference}) {
    for (const std::vector<float>& plane : picture->plane) {
      if (plane.size() != picture->pixels())
        throw std::invalid_argument("difference_picture: planes not whole");
    }
  }
  if (!(gain > 0) || !std::isfinite(gain) || panel_px < 1) {
    throw std::invalid_argument("difference_picture: gain or panel not positive");
  }
}

}  // namespace

StudyPicture difference_picture(const std::string& title, const LinearPicture& test,
                                const LinearPicture& reference, double gain, int panel_px) {
  check_pictures(test, reference, gain, panel_px);
  const int box = (test.width_px + panel_px - 1) / panel_px;
  const int width = (test.width_px + box - 1) / box, height = (test.height_px + box - 1) / box;
  Srgb8Image image;
  image.width_px = 3 * width + 2 * kPanelGap_px;
  image.height_px = height;
  image.values.assign(3 * static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(height), 255);
  const auto put = [&](int panel, int column, int row, const Pixel& pixel) {
    const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width_px) +
                    static_cast<std::size_t>(panel * (width + kPanelGap_px) + column);
    std::copy(pixel.begin(), pixel.end(), image.values.begin() + static_cast<std::ptrdiff_t>(3 * at));
  };
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      put(0, column, row, colour_of(test, box, column, row));
      put(1, column, row, colour_of(reference, box, column, row));
      const double difference =
          box_mean(test, box, column, row, [&](std::size_t i) { return difference_at(test, reference, i); });
      put(2, column, row, black_body(gain * difference));
    }
  }
  StudyPicture picture;
  picture.title = title;
  picture.caption = "Left: picture. Middle: reference. Right: difference of the brightest channel times " +
                    shortest_text(gain) + ", from black over red and yellow to white.";
  picture.width_px = image.width_px;
  picture.height_px = image.height_px;
  encode_png(image, picture.png, kPicturePngLevel);
  return picture;
}

}  // namespace herr
