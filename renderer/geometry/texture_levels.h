// A texture and its smaller levels: each level has half the width and height, rounded down, at least 1.
// Before: Scene::textures. After: shading and alpha tests fetch from them. A third more memory than level 0.
#pragma once

#include "renderer/geometry/shading_scene.h"
#include "renderer/geometry/texel_memory.h"
#include "scenes/model/scene.h"

namespace herr {

struct TextureLevels {
  TexelVector texels;
  TextureRecord record;  // points into texels
};

// Each texel of a level is the mean of the area that it covers in the level below it - of odd sizes shares of
// three texels - in linear light, colours weighted by alpha where that is coverage.
TextureLevels build_levels(const TextureImage& image);

}  // namespace herr
