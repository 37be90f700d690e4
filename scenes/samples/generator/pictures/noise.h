// Repeatable noise for textures and rough surfaces: hashed lattices, the same on every machine.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace herr::samples {

// Uniform in [0, 1), a pure function of its arguments.
float hashed(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed);

// Value noise: smooth, in [-1, 1], one feature per unit. Where period > 0 it repeats along x or y.
float smooth_noise(const glm::vec3& p, std::uint32_t seed, const glm::ivec2& period = glm::ivec2(0));

// Sum of `octaves` of smooth_noise, each half as large and twice as fine; in [-2, 2].
float layered_noise(const glm::vec3& p, int octaves, std::uint32_t seed,
                    const glm::ivec2& period = glm::ivec2(0));

}  // namespace herr::samples
