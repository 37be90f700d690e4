// A small YAML file as the JSON values that it stands for. Anchors, aliases and merge keys are refused: a few
// of them can stand for more than memory holds. Before: a file. After: yaml_calibration.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace herr {

// The first document. Plain numbers become numbers, other scalars texts. Throws InputError with the line: no
// YAML, more than 256 KiB, deeper than 16, more than 20000 values, a key twice.
nlohmann::json read_yaml_file(const std::filesystem::path& file);

}  // namespace herr
