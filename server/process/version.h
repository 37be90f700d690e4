// Name and version of the program, as written into every output.
#pragma once

namespace herr {

const char* program_version();       // "0.1.0"
const char* program_with_version();  // "herr 0.1.0"

}  // namespace herr
