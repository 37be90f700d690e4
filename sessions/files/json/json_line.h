// The line on which a field of a JSON text stands, for errors that are found after the text was parsed.
// Before: a text and a field as JsonObject names it. After: JsonObject::fail.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace herr {

// Lines count from 1. `field`: "lights[0].path.times", or "" for the document. Of a field that is not there,
// the line of the innermost object or array around it. 0: `text` is not one JSON value, or is nested deeper
// than 64 levels.
std::int64_t json_line(std::string_view text, const std::string& field);

}  // namespace herr
