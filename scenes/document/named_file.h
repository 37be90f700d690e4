// A file that a field of a scene document names: below the document's folder, so that a scene can be copied
// as a folder, or below a folder of models that the user names. Before: scene_document walks the document.
// After: the loaders. Names are not trusted: they open only beneath these folders
// (sessions/files/contained_folder.h).
#pragma once

#include <filesystem>
#include <span>

#include "sessions/files/strict_json.h"

namespace herr {

// In the document's folder, else in the first of `asset_roots` that has it. Throws InputError that names the
// field: for a path that is absolute or has "..", for a link that leads out of the folder in which it lies,
// and where the file is nowhere.
std::filesystem::path named_file(const JsonObject& entry, const char* key,
                                 std::span<const std::filesystem::path> asset_roots);

// Throws InputError for one that is no folder.
void check_asset_roots(std::span<const std::filesystem::path> asset_roots);

}  // namespace herr
