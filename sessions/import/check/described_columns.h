// What chosen columns mean, in whole sentences. Before: choose_format. After: proposal.
#pragma once

#include <string>
#include <vector>

#include "sessions/import/import_rows.h"

namespace herr {

std::vector<std::string> described(const ImportColumns& columns);

}  // namespace herr
