// File names that come out of a recording are not trusted: they must stay in the folder that they are
// relative to. Before: a camera stream's filename column. After: the image reader.
#pragma once

#include <filesystem>
#include <string>

namespace herr {

// The file `name` inside `folder`, symbolic links resolved. Throws std::invalid_argument whose text says what
// is wrong with the name: empty, absolute, "." or ".." or an empty part, a control character or backslash,
// missing, or a link that leads out of the folder.
std::filesystem::path contained_path(const std::filesystem::path& folder, const std::string& name);

}  // namespace herr
