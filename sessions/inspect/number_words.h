// Numbers in the words of a finding, the same in every locale.
#pragma once

#include <cstdint>
#include <string>

#include "sessions/format/pose.h"

namespace herr {

std::string milliseconds(TimeNs ns);                          // "48.5 ms"
std::string percentage(std::int64_t part, std::int64_t all);  // "42.1 %"; all > 0
std::string counted(std::int64_t count, const std::string& one, const std::string& many);  // "1 blink"

}  // namespace herr
