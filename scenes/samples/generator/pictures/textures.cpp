#include "scenes/samples/generator/pictures/textures.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/samples/generator/pictures/noise.h"
#include "scenes/samples/generator/shapes/mesh.h"

namespace herr::samples {

namespace {

using glm::mix;
using glm::smoothstep;
using glm::vec2;
using glm::vec3;

float fraction(float x) {
  return x - std::floor(x);
}

// 1 on a line of half width `half` around 0, soft at its edges.
float line(float distance, float half) {
  return 1.0f - smoothstep(0.6f * half, half, std::abs(distance));
}

// Fibres run along y; repeats after one unit in x and y.
vec3 grain(const vec2& at, const vec3& light, const vec3& dark, std::uint32_t seed) {
  const float bend = layered_noise({at.x * 3.0f, at.y, 0.5f}, 3, seed, {3, 1});
  const float rings = 0.5f + 0.5f * std::sin(2.0f * kPi * (at.x * 14.0f + 1.1f * bend));
  const float fibre = layered_noise({at.x * 64.0f, at.y * 4.0f, 7.5f}, 2, seed + 9, {64, 4});
  return mix(light, dark, glm::clamp(0.55f * rings + 0.18f * fibre, 0.0f, 1.0f));
}

}  // namespace

Picture wood_picture() {
  return paint(256, 256, [](const vec2& uv) {
    return grain(uv, {0.62f, 0.40f, 0.22f}, {0.36f, 0.20f, 0.10f}, 11);
  });
}

Picture marble_picture() {
  return paint(512, 512, [](const vec2& uv) {
    const vec3 p(3.0f * uv.x, 7.0f * uv.y, 0.5f);
    const float warp = layered_noise(p, 5, 21);
    const float vein = std::pow(1.0f - std::abs(std::sin(2.2f * (p.x + 0.6f * p.y) + 2.6f * warp)), 5.0f);
    const float cloud = 0.5f + 0.25f * layered_noise(2.0f * p, 4, 33);
    const vec3 white = mix(vec3(0.93f, 0.91f, 0.88f), vec3(0.84f, 0.83f, 0.83f), cloud);
    return mix(white, vec3(0.50f, 0.51f, 0.55f), 0.7f * vein);
  });
}

Picture porcelain_picture() {
  const vec3 white(0.93f, 0.94f, 0.95f), cobalt(0.07f, 0.14f, 0.48f);
  return paint(512, 512, [=](const vec2& uv) {
    // The outer wall takes v = 1 ... 0.47, from the foot to the lip; the inside is plain.
    const float height = (1.0f - uv.y) / 0.53f;
    if (height > 1.0f) return white;
    float ink = 0.0f;
    for (const float band : {0.10f, 0.13f, 0.40f, 0.68f, 0.72f, 0.97f}) ink += line(height - band, 0.008f);
    // Waves near the foot, flowers round the belly, teeth on the shoulder.
    const float wave = height - 0.20f - 0.035f * std::sin(2.0f * kPi * 14.0f * uv.x);
    ink += line(wave, 0.012f) + line(wave - 0.05f, 0.009f);
    const vec2 cell(fraction(uv.x * 7.0f) - 0.5f, (height - 0.54f) * 3.6f);
    const float reach = glm::length(cell);
    const float petals = 0.25f + 0.15f * std::cos(6.0f * std::atan2(cell.y, cell.x));
    ink += smoothstep(petals, petals - 0.03f, reach) * smoothstep(0.06f, 0.09f, reach);
    ink += line(reach - 0.46f, 0.025f);
    ink += height > 0.75f && height < 0.87f ? line(fraction(uv.x * 24.0f) - 0.5f, 3.2f * (0.88f - height))
                                            : 0.0f;
    return mix(white, cobalt, glm::clamp(ink, 0.0f, 1.0f));
  });
}

Picture shell_picture() {
  return paint(512, 512, [](const vec2& uv) {
    const float warp = layered_noise({6.0f * uv.x, 30.0f * uv.y, 0.5f}, 3, 41);
    const float flame = smoothstep(
        0.1f, 0.5f, std::sin(2.0f * kPi * 26.0f * uv.y + 1.6f * warp + 2.5f * std::sin(4.0f * kPi * uv.x)));
    const float ridge = 0.5f + 0.5f * std::sin(2.0f * kPi * 12.0f * uv.x);
    const vec3 cream = mix(vec3(0.95f, 0.87f, 0.74f), vec3(0.90f, 0.74f, 0.60f), ridge);
    return mix(cream, vec3(0.60f, 0.27f, 0.13f), 0.85f * flame);
  });
}

Picture plant_picture() {
  return paint(256, 384, [](const vec2& uv) {
    const float third = 3.0f * uv.y;
    const float speck = layered_noise({48.0f * uv.x, 72.0f * uv.y, 0.5f}, 3, 51);
    if (third > 2.0f) return vec3(0.20f, 0.14f, 0.10f) + 0.06f * speck;
    if (third > 1.0f) return vec3(0.72f, 0.36f, 0.23f) + 0.03f * speck;
    // A leaf: u from stem to tip, the rib in the middle, veins slanting away from it.
    const float side = std::abs(third - 0.5f);
    const float vein = line(fraction(14.0f * uv.x - 7.0f * side) - 0.5f, 0.16f);
    const vec3 green =
        mix(vec3(0.13f, 0.36f, 0.12f), vec3(0.27f, 0.55f, 0.20f), smoothstep(0.0f, 1.0f, uv.x));
    const vec3 veined = mix(green, vec3(0.45f, 0.68f, 0.32f), 0.45f * vein);
    return mix(veined + 0.02f * speck, vec3(0.62f, 0.76f, 0.42f), line(side, 0.045f));
  });
}

Picture planks_picture() {
  return paint(512, 512, [](const vec2& uv) {
    // Eight boards side by side, each row shifted so that the joints do not line up.
    const float across = 8.0f * uv.x;
    const int board = static_cast<int>(across);
    const float along = uv.y + 0.37f * static_cast<float>(board * 3 % 8);
    const int piece = static_cast<int>(std::floor(along)) & 1;
    const float tone = hashed(board, piece, 0, 61);
    const vec2 inside(fraction(across), fraction(along));
    const vec3 light = mix(vec3(0.72f, 0.55f, 0.37f), vec3(0.62f, 0.44f, 0.28f), tone);
    const vec3 wood =
        grain({0.25f * inside.x + tone, uv.y}, light, 0.78f * light, 63 + static_cast<std::uint32_t>(board));
    const float gap = std::max(line(std::min(inside.x, 1.0f - inside.x), 0.03f),
                               line(std::min(inside.y, 1.0f - inside.y), 0.004f));
    return mix(wood, vec3(0.22f, 0.15f, 0.10f), gap);
  });
}

Picture rug_picture() {
  return paint(256, 512, [](const vec2& uv) {
    const vec3 red(0.52f, 0.13f, 0.13f), blue(0.12f, 0.17f, 0.32f), sand(0.85f, 0.76f, 0.58f);
    const float edge = std::min({uv.x * 1.6f, (1.0f - uv.x) * 1.6f, uv.y * 2.4f, (1.0f - uv.y) * 2.4f});
    const float weave = 0.03f * smooth_noise({256.0f * uv.x, 512.0f * uv.y, 0.5f}, 71);
    if (edge < 0.07f) return sand + weave;
    if (edge < 0.22f) {
      const float zigzag = fraction(12.0f * (uv.x + uv.y)) < 0.5f ? 0.0f : 1.0f;
      return mix(blue, sand, 0.35f * zigzag) + weave;
    }
    if (edge < 0.26f) return sand + weave;
    const vec2 cell(fraction(3.0f * uv.x) - 0.5f, fraction(5.0f * uv.y) - 0.5f);
    const float lozenge = std::abs(cell.x) + std::abs(cell.y);
    if (lozenge < 0.12f) return sand + weave;
    if (lozenge < 0.30f) return blue + weave;
    return (lozenge < 0.34f ? sand : red) + weave;
  });
}

Picture poster_picture() {
  return paint(256, 384, [](const vec2& uv) {
    const float border = std::min({uv.x, 1.0f - uv.x, 1.5f * uv.y, 1.5f * (1.0f - uv.y)});
    if (border < 0.05f) return vec3(0.95f, 0.93f, 0.88f);
    vec3 colour = mix(vec3(0.96f, 0.66f, 0.36f), vec3(0.98f, 0.87f, 0.66f), uv.y * 1.6f);
    if (glm::length((uv - vec2(0.62f, 0.36f)) * vec2(1.0f, 1.5f)) < 0.15f) colour = {0.90f, 0.30f, 0.20f};
    for (int hill = 0; hill < 4; ++hill) {
      const auto depth = static_cast<float>(hill);
      const float crest = 0.48f + 0.12f * depth +
                          0.08f * smooth_noise({uv.x * (2.5f + depth) + 9.0f * depth, 0.5f, 0.5f}, 81);
      if (uv.y > crest) colour = mix(vec3(0.45f, 0.55f, 0.62f), vec3(0.08f, 0.20f, 0.26f), depth / 3.0f);
    }
    return colour;
  });
}

Picture sky_picture() {
  return paint(256, 256, [](const vec2& uv) {
    const float cloud = smoothstep(0.0f, 0.9f, layered_noise({4.0f * uv.x, 7.0f * uv.y, 0.5f}, 4, 91));
    const vec3 sky = mix(vec3(0.48f, 0.68f, 0.93f), vec3(0.82f, 0.90f, 0.97f), uv.y);
    const float trees = 0.82f + 0.06f * layered_noise({9.0f * uv.x, 0.5f, 0.5f}, 3, 95);
    return uv.y > trees ? vec3(0.24f, 0.36f, 0.20f) : mix(sky, vec3(0.97f), 0.8f * cloud);
  });
}

Picture books_picture() {
  return paint(256, 64, [](const vec2& uv) {
    const float at = 20.0f * uv.x;
    const int book = static_cast<int>(at);
    const vec3 cover(hashed(book, 0, 0, 101), hashed(book, 1, 0, 101), hashed(book, 2, 0, 101));
    const vec3 muted = 0.15f + 0.55f * mix(vec3((cover.x + cover.y + cover.z) / 3.0f), cover, 0.7f);
    const float gap = line(std::min(fraction(at), 1.0f - fraction(at)), 0.08f);
    const float label = uv.y > 0.25f && uv.y < 0.40f ? 0.5f : 0.0f;
    return mix(mix(muted, vec3(0.90f, 0.82f, 0.55f), label), vec3(0.06f), gap);
  });
}

}  // namespace herr::samples
