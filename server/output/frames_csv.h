// frames.csv: one row per frame, units in every column name. Empty cells mean "not applicable".
#pragma once

#include <string>

#include "server/statistics/frame_record.h"

namespace herr {

// Both end with a line break; every row has as many cells as the header.
std::string frames_csv_header();
std::string frames_csv_row(const FrameRecord& record);

}  // namespace herr
