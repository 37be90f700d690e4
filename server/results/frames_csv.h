// frames.csv: one row per frame, units in every column name. Empty cells mean "not applicable".
// Before: the replay loop fills a FrameRecord. After: users' tools, and a resumed replay, which reads the
// rows of the frames that an interrupted one finished.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/statistics/frame_record.h"

namespace herr {

// Both end with a line break; every row has as many cells as the header.
std::string frames_csv_header();
std::string frames_csv_row(const FrameRecord& record);

// The record of a row (without its line break), with times to the nanosecond that the row states them to;
// none when it is no row of this header.
std::optional<FrameRecord> frame_record_of(std::string_view row);

}  // namespace herr
