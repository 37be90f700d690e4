// The lens of a camera from columns that a recorder writes with every row (Stray Scanner, ARKit loggers):
// focal lengths and principal point in pixels, an ideal pinhole. Before: a table, a map's camera columns.
// After: session.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sessions/camera/camera_image.h"
#include "sessions/camera/camera_model.h"
#include "sessions/import/map/column_map.h"

namespace herr {

struct ColumnLens {
  CameraModel model;                 // medians over all rows that have numbers
  std::vector<std::string> remarks;  // that the numbers change by more than 1 %: autofocus; a whole sentence
};

// columns.lens is not empty. For pictures of `size`; throws InputError where the principal point lies too far
// from their middle: the numbers are then for pictures of another size.
ColumnLens lens_from_columns(const std::filesystem::path& table, const CameraColumns& columns,
                             const ImageSize& size);

}  // namespace herr
