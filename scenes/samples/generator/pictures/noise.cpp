#include "scenes/samples/generator/pictures/noise.h"

#include <cmath>
#include <glm/common.hpp>

namespace herr::samples {

float hashed(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
  // Multiply and fold (the finaliser of MurmurHash3): neighbours get unrelated values.
  std::uint32_t h = seed * 0x9e3779b9u + static_cast<std::uint32_t>(x) * 0x85ebca6bu +
                    static_cast<std::uint32_t>(y) * 0xc2b2ae35u + static_cast<std::uint32_t>(z) * 0x27d4eb2fu;
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  return static_cast<float>((h ^ (h >> 16)) >> 8) * (1.0f / 16777216.0f);
}

float smooth_noise(const glm::vec3& p, std::uint32_t seed, const glm::ivec2& period) {
  const glm::vec3 cell = glm::floor(p);
  const glm::vec3 t = p - cell;
  const glm::vec3 s = t * t * (3.0f - 2.0f * t);
  const auto wrapped = [](float coordinate, int length) {
    const auto i = static_cast<std::int32_t>(coordinate);
    return length > 0 ? ((i % length) + length) % length : i;
  };
  float sum = 0.0f;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 offset(corner & 1, (corner >> 1) & 1, corner >> 2);
    const glm::vec3 weight = glm::mix(1.0f - s, s, glm::vec3(offset));
    const glm::vec3 at = cell + glm::vec3(offset);
    const float value =
        hashed(wrapped(at.x, period.x), wrapped(at.y, period.y), static_cast<std::int32_t>(at.z), seed);
    sum += weight.x * weight.y * weight.z * (2.0f * value - 1.0f);
  }
  return sum;
}

float layered_noise(const glm::vec3& p, int octaves, std::uint32_t seed, const glm::ivec2& period) {
  float sum = 0.0f, size = 1.0f;
  std::int32_t scale = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += size * smooth_noise(p * static_cast<float>(scale), seed + static_cast<std::uint32_t>(octave),
                               period * scale);
    size *= 0.5f;
    scale *= 2;
  }
  return sum;
}

}  // namespace herr::samples
