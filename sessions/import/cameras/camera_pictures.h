// The pictures of a folder as a camera feed: which, in which order, of which size.
// Before: `--camera DIR`. After: the program copies them into cam0/data and stamps them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sessions/camera/camera_image.h"

namespace herr {

struct CameraPictures {
  std::vector<std::filesystem::path> files;  // in natural order of their names: 1, 2, 10
  ImageSize size;                            // of each of them
};

// All JPEG, PNG and EXR files of the folder (not of folders in it). Throws InputError: no such folder, no
// picture, one that cannot be read or that has another size. `keep`: of a name without its extension; others
// are passed over.
CameraPictures find_camera_pictures(const std::filesystem::path& folder,
                                    const std::function<bool(const std::string&)>& keep = {});

// Numbers within names count as numbers: "2.jpg" comes before "10.jpg".
bool natural_less(const std::string& a, const std::string& b);

}  // namespace herr
