// File names that come out of a recording are not trusted: they must be plain, and stay in the folder that
// they are relative to. Before: a camera stream's filename column. After: the image reader.
#pragma once

#include <filesystem>
#include <string>

#include "sessions/files/input_file.h"

namespace herr {

// The file `name` inside `folder`, opened. Links are followed as long as they stay inside. Throws InputError
// with `remedy` for a name that is empty or absolute, has "." or ".." or an empty part, a control character
// or a backslash, or that leads nowhere or out of the folder; as InputFile does for what is no readable file.
InputFile open_recorded(const std::filesystem::path& folder, const std::string& name,
                        const std::string& remedy);

}  // namespace herr
