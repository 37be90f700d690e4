// The part of the report that describes a scene.
#pragma once

#include <string>

#include "server/inspect/inspect_report.h"

namespace herr {

// report.scene must be there.
std::string scene_text(const InspectReport& report);

}  // namespace herr
