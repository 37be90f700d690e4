// What becomes of each extension of glTF: read, or left out with a loss that can be named. The one table of
// them. Before: the names in a document. After: gltf_checks, extension_losses.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace herr {

// Whether a file that requires the extension is shown as it asks.
bool is_read_extension(std::string_view name);

// Whether its loss is known.
bool is_known_extension(std::string_view name);

// What a picture lacks where an extension is not read: "shown without ...". `has_picture`: a texture names a
// picture of glTF's own beside the one of the extension.
std::string extension_loss(std::string_view name, bool has_picture);

// What to do with a file that requires an extension which is not read.
std::string extension_remedy(const std::string& name);

// Whether the document cannot be shown without the extension.
bool requires_extension(const nlohmann::json& document, std::string_view name);

}  // namespace herr
