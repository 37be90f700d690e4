// The part of the report that describes a recording: header, streams, ages, offsets, head and eyes.
#pragma once

#include <string>

#include "server/inspect/inspect_report.h"

namespace herr {

// report.session must be there.
std::string session_text(const InspectReport& report);

}  // namespace herr
