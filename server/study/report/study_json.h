// study.json: a StudyRecord, written and read again without loss. Before: a study. After: any report of it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "server/study/report/study_record.h"

namespace herr {

class JsonObject;

// Numbers that are not finite are left out (null in arrays); pictures are base64. Ends with "definitions" of
// metrics, bands and figures.
nlohmann::ordered_json study_json(const StudyRecord& record);

// Throws InputError for what is no study.json of this version, with the field; `source` names the file.
StudyRecord read_study(const nlohmann::json& document, const std::string& source);

// Parts that other reports have too. read_: throws InputError. A head is the fields "program" to "threads".
void put_head(nlohmann::ordered_json& json, const ReportHead& head);
void read_head(const JsonObject& object, ReportHead& head);
nlohmann::ordered_json study_frame_json(const StudyFrame& frame);
nlohmann::ordered_json study_picture_json(const StudyPicture& picture);
StudyFrame read_study_frame(const JsonObject& object);
StudyPicture read_study_picture(const JsonObject& object);
std::vector<std::string> read_study_lines(const JsonObject& object, const char* key);

}  // namespace herr
