// What a conversion did, as text for people and as JSON. Before: run_convert. After: stdout.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "sessions/import/import_report.h"
#include "sessions/session.h"

namespace herr {

struct ConvertReport {
  std::filesystem::path out;
  std::string map;
  ImportReport rows;
  std::int64_t pictures = 0, camera_rows = 0;
  SessionFindings findings;  // of opening the result
};

std::string convert_text(const ConvertReport& report);
std::string convert_json(const ConvertReport& report);

}  // namespace herr
