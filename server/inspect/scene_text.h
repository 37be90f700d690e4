// The part of the report that describes a scene.
#pragma once

#include <string>

#include "server/inspect/inspect_report.h"

namespace herr {

// "  NAME        VALUE": a line of both parts, session and scene.
std::string named_line(const std::string& name, const std::string& value);

// report.scene must be there.
std::string scene_text(const InspectReport& report);

}  // namespace herr
