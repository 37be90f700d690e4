// The report of `herr inspect` for people: what it is, its streams, the plots, the frame plan, and last, next
// to the prompt, what is wrong. Tables and plots fit into 80 columns.
#pragma once

#include <string>

#include "server/inspect/inspect_report.h"

namespace herr {

std::string inspect_text(const InspectReport& report);

}  // namespace herr
