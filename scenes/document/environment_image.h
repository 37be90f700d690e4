// Reads an equirectangular picture of the light around a scene: Radiance .hdr, EXR, or PNG and JPEG as sRGB.
// Before: scene_document. After: Scene::environment_map.
#pragma once

#include <filesystem>

#include "scenes/model/scene.h"

namespace herr {

// The picture as it is, turn 0. Negative and not finite values become 0, those above 65504 that; how many is
// written to Scene::warnings by the caller through `sanitised_values`. Throws InputError for a file that is
// no picture of one of these formats, is damaged or larger than 8192 x 4096.
EnvironmentImage read_environment_image(const std::filesystem::path& file, std::int64_t& sanitised_values);

}  // namespace herr
