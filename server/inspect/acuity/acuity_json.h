// AcuityFacts for programs: part of `herr inspect --json`, whose schema stands in README.md of this folder.
// Before: acuity_facts. After: inspect_json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "server/inspect/acuity/acuity_facts.h"

namespace herr {

nlohmann::ordered_json acuity_json(const AcuityFacts& facts);

}  // namespace herr
