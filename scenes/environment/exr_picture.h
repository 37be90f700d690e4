// An EXR as a picture of an environment. Before: environment_image knows the format. After:
// Scene::environment_map.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/model/scene.h"

namespace herr {

// The display window; what of it lies outside the data window is black. `remarks` get one line each, without
// the file's name. Throws InputError: tiled, deep, of several parts, in a compression that is not read,
// damaged.
EnvironmentImage read_exr_picture(std::string_view bytes, const std::filesystem::path& file,
                                  std::vector<std::string>& remarks);

}  // namespace herr
