// The report of a check as text for people, as JSON for programs. Before: CheckReport. After: stdout.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "server/check/report/check_report.h"

namespace herr {

std::string check_text(const CheckReport& report);
nlohmann::ordered_json check_json(const CheckReport& report);

}  // namespace herr
