// Pairs of pictures by formula, on which the product's FLIP and the slow one are compared: what renderers get
// wrong (bands, noise, shifted edges, lost points) and what the filters are made for (gratings).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "server/study/error/linear_picture.h"
#include "tests/server/study/error/slow_flip.h"

namespace herr::slow_flip {

struct Pair {
  std::string name;
  Picture test, reference;
};

// Colour at the column x and row y; kept as floats keep it, so that both programs get the same numbers.
inline Picture picture(int width, int height, const std::function<glm::dvec3(double x, double y)>& colour) {
  Picture out(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      out.pixels[out.index(x, y)] = glm::dvec3(glm::vec3(glm::clamp(colour(x, y), 0.0, 1.0)));
    }
  }
  return out;
}

inline LinearPicture linear(const Picture& picture) {
  LinearPicture out;
  out.width_px = picture.width;
  out.height_px = picture.height;
  for (int c = 0; c < 3; ++c) {
    for (const glm::dvec3& pixel : picture.pixels) {
      out.plane[static_cast<std::size_t>(c)].push_back(static_cast<float>(pixel[c]));
    }
  }
  return out;
}

// In [0, 1), the same everywhere. Source of the hash: Wellons, "Prospecting for hash functions" (lowbias32).
inline double hashed(double x, double y, std::uint32_t seed) {
  std::uint32_t h = static_cast<std::uint32_t>(x) + 4096 * static_cast<std::uint32_t>(y) + (seed << 24);
  h = (h ^ (h >> 16)) * 0x7FEB352DU;
  h = (h ^ (h >> 15)) * 0x846CA68BU;
  return (h ^ (h >> 16)) / 4294967296.0;
}

inline Picture noise(int width, int height, std::uint32_t seed) {
  return picture(width, height, [seed](double x, double y) {
    return glm::dvec3{hashed(x, y, seed), hashed(x, y, seed + 1), hashed(x, y, seed + 2)};
  });
}

// A disc with a rim one pixel wide.
inline Picture disc(int width, int height, double middle_x) {
  return picture(width, height, [=](double x, double y) {
    const double inside = std::clamp(20.5 - std::hypot(x - middle_x, y - 30.25), 0.0, 1.0);
    return glm::mix(glm::dvec3{0.08, 0.2, 0.35}, glm::dvec3{0.9, 0.25, 0.1}, inside);
  });
}

// Bands of gratings with 2.5 to 40 pixels a period, grey above and red against green below.
inline Picture gratings(int width, int height, double contrast, double phase) {
  return picture(width, height, [=](double x, double y) {
    const double period = 2.5 * std::exp2(std::floor(y / 13));
    const double wave = contrast * std::sin(2 * std::numbers::pi * x / period + phase);
    const bool grey = static_cast<int>(y) % 13 < 7;
    return grey ? glm::dvec3{0.4 + 0.4 * wave} : glm::dvec3{0.5 + 0.4 * wave, 0.4 - 0.1 * wave, 0.3};
  });
}

inline std::vector<Pair> pairs() {
  constexpr int kWidth = 96, kHeight = 64;
  const auto make = [](const std::function<glm::dvec3(double x, double y)>& colour) {
    return picture(kWidth, kHeight, colour);
  };
  const auto squares = [](double x, double y, double size) {
    return std::fmod(std::floor(x / size) + std::floor(y / size), 2.0) > 0.5;
  };
  // Light to the right of a slanted line through the middle, `wide` pixels from dark to light.
  const auto edge = [](double x, double y, double wide) {
    return std::clamp(0.5 + (x - 30 - 0.4 * y) / wide, 0.0, 1.0);
  };
  std::vector<Pair> out;
  out.push_back(
      {"gradient and its bands", make([](double x, double y) { return glm::dvec3{(x + 0.2 * y) / 110}; }),
       make([](double x, double y) { return glm::dvec3{std::floor((x + 0.2 * y) / 9) * 9 / 110}; })});
  out.push_back({"colour ramps", make([](double x, double y) {
                   return glm::dvec3{x / 95, y / 63, 1 - x / 95};
                 }),
                 make([](double x, double y) {
                   return glm::dvec3{x / 100, 0.1 + 0.8 * y / 63, 0.9 - 0.7 * x / 95};
                 })});
  out.push_back({"gratings", gratings(kWidth, kHeight, 0.9, 0.3), gratings(kWidth, kHeight, 0.5, 0.7)});
  out.push_back(
      {"checkerboards", make([&](double x, double y) {
         return squares(x, y, 3) ? glm::dvec3{0.85, 0.8, 0.3} : glm::dvec3{0.1, 0.15, 0.5};
       }),
       make([&](double x, double y) {
         return squares(x + 0.7 * y, y, 4) ? glm::dvec3{0.8, 0.7, 0.4} : glm::dvec3{0.05, 0.2, 0.45};
       })});
  out.push_back({"sharp and soft edges", make([&](double x, double y) {
                   return glm::mix(glm::dvec3{0.02, 0.03, 0.05}, glm::dvec3{0.95, 0.9, 0.8}, edge(x, y, 1));
                 }),
                 make([&](double x, double y) {
                   return glm::mix(glm::dvec3{0.02, 0.03, 0.05}, glm::dvec3{0.9, 0.9, 0.85}, edge(x, y, 9));
                 })});
  out.push_back(
      {"points", make([](double x, double y) {
         return glm::dvec3{0.1} + glm::dvec3{0.9, 0.8, 0.6} * (hashed(x, y, 7) > 0.97 ? 1.0 : 0.0);
       }),
       make([](double x, double y) {
         return glm::dvec3{0.12} + glm::dvec3{0.7, 0.8, 0.8} * (hashed(x, y, 7) > 0.985 ? 1.0 : 0.0);
       })});
  out.push_back({"noise", noise(kWidth, kHeight, 11), noise(kWidth, kHeight, 21)});
  out.push_back({"shifted disc", disc(kWidth, kHeight, 44.5), disc(kWidth, kHeight, 45.5)});
  return out;
}

}  // namespace herr::slow_flip
