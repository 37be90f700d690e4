#include "sessions/import/import_report.h"

namespace herr {

std::int64_t ImportedStream::lost(RowFate fate) const {
  if (fate == RowFate::lost_tracking && lost_rows_stay) return 0;
  return row_fate_texts()[static_cast<std::size_t>(fate)].loss ? fates[fate] : 0;
}

double ImportedStream::lost_share() const {
  if (rows_read == 0) return 0;
  std::int64_t all = 0;
  for (std::size_t fate = 0; fate < kRowFates; ++fate) all += lost(static_cast<RowFate>(fate));
  return static_cast<double>(all) / static_cast<double>(rows_read);
}

}  // namespace herr
