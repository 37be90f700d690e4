// study.json: a StudyRecord, written and read again without loss. Before: a study. After: any report of it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "server/study/report/study_record.h"

namespace herr {

// Numbers that are not finite are left out (null in arrays); pictures are base64. Ends with "definitions" of
// metrics, bands and figures.
nlohmann::ordered_json study_json(const StudyRecord& record);

// Throws InputError for what is no study.json of this version, with the field; `source` names the file.
StudyRecord read_study(const nlohmann::json& document, const std::string& source);

}  // namespace herr
