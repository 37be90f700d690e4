// A Radiance picture as linear RGB, upright. Before: environment_image knows the format. After:
// Scene::environment_map.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/model/scene.h"

namespace herr {

// Radiance = pixel / (product of EXPOSURE and COLORCORR); a pixel is its mantissas times 2^(exponent - 136).
// CIE XYZ becomes RGB by the format's own primaries and white, Y in the unit of RGB. `remarks` get one line
// each, without the file's name. Throws InputError.
EnvironmentImage read_radiance_picture(std::string_view bytes, const std::filesystem::path& file,
                                       std::vector<std::string>& remarks);

}  // namespace herr
