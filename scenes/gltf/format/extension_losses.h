// Which extensions of a document are not read, which of its materials, nodes or other parts use them, and
// what is lost. Before: gltf_checks. After: a scene's warnings, `herr inspect`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace herr {

// One line for each extension and loss, in the order of the alphabet. `document` is nested no deeper than
// strict_json lets pass. `used`: extensionsUsed.
std::vector<std::string> extension_losses(const nlohmann::json& document,
                                          const std::vector<std::string>& used);

}  // namespace herr
