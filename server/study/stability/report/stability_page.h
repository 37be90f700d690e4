// stability.html: the stability report as one page without scripts that loads nothing. Before:
// StabilityRecord. After: a browser, or paper.
#pragma once

#include <string>

#include "server/study/stability/report/stability_record.h"

namespace herr {

std::string stability_page(const StabilityRecord& record);

}  // namespace herr
