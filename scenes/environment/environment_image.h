// Reads an equirectangular picture of the light around a scene: Radiance .hdr, EXR, or PNG and JPEG as sRGB,
// told apart by their first bytes. Before: scene_document. After: Scene::environment_map.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/model/scene.h"

namespace herr {

// The picture, upright, turn 0. What was guessed, left out or brought into range is written to `remarks`, one
// line each, without the file's name. Throws InputError for a file that is no picture of one of these
// formats, is damaged or larger than 8192 x 4096.
EnvironmentImage read_environment_image(const std::filesystem::path& file, std::vector<std::string>& remarks);

}  // namespace herr
