// The parts of a column map as JSON; what has its default is left out. Private to this folder.
// Before: the types of column_map.h. After: column_map_text puts them together.
#pragma once

#include <nlohmann/json.hpp>

#include "sessions/import/map/column_map.h"

namespace herr {

using MapJson = nlohmann::ordered_json;  // keys stay in the order in which they are written

MapJson json_of(const ColumnRef& ref);
MapJson json_of(const ColumnGroup& group);
MapJson json_of(const AxisDirections& axes);
MapJson json_of(const TimeColumns& time);
MapJson json_of(const RowFilter& filter);
void write_table(const TableFormat& table, MapJson& entry);
void write_filter(const RowFilter& filter, const char* key, MapJson& entry);  // unless it passes all

MapJson json_of(const HeadColumns& head);
MapJson json_of(const GazeColumns& gaze);

}  // namespace herr
