#include "sessions/import/rows/places.h"

namespace herr {
Places::Places(RowSource& rows, const ColumnGroup& group) : numbers_(group.numbers) {
  if (group.columns.size() > kMost || numbers_ > kMost)
    rows.fail("the map asks for more than 16 numbers at once", "check the columns of the map");
  for (const ColumnRef& column : group.columns) places_[columns_++] = rows.place(column);
}

Places::Places(RowSource& rows, const std::optional<ColumnGroup>& group) {
  if (group) *this = Places(rows, *group);
}

bool Places::read(const RowSource& rows, std::span<double> values) const {
  if (columns_ == 1 && numbers_ > 1) {
    if (rows.absent(places_[0])) return false;
    rows.numbers(places_[0], values);
    return true;
  }
  for (std::size_t i = 0; i < columns_; ++i) {
    if (rows.absent(places_[i])) return false;
    values[i] = rows.number(places_[i]);
  }
  return true;
}

bool Places::read(const RowSource& rows, glm::dvec3& values) const {
  std::array<double, 3> three{};
  if (!read(rows, three)) return false;
  values = {three[0], three[1], three[2]};
  return true;
}

void add_columns(const std::optional<ColumnGroup>& group, std::vector<ColumnRef>& columns) {
  if (group) columns.insert(columns.end(), group->columns.begin(), group->columns.end());
}

}  // namespace herr
