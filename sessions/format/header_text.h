// session.json of a header, as session_header reads it back. Before: whoever records or imports a session.
// After: session_recorder writes it.
#pragma once

#include <string>

#include "sessions/format/session_header.h"

namespace herr {

// Format version 1, two spaces of indentation, with a line end. A built-in display profile is named, any
// other is written out.
std::string header_text(const SessionHeader& header);

}  // namespace herr
