// stability.json: a StabilityRecord, written and read again without loss. Before: measured relations. After:
// any report of them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "server/study/stability/report/stability_record.h"

namespace herr {

// A number that is not finite is null, with its text beside: "error": null, "error_text": "nan".
nlohmann::ordered_json stability_json(const StabilityRecord& record);

bool is_stability_json(const nlohmann::json& document);
// Throws InputError for what is no stability.json of this version, with the field; `source` names the file.
StabilityRecord read_stability(const nlohmann::json& document, const std::string& source);

}  // namespace herr
