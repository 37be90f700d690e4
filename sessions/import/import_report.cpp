#include "sessions/import/import_report.h"

namespace herr {

bool ImportedStream::loses(RowFate fate) const {
  if (fate == RowFate::lost_tracking && keeps_lost_tracking) return false;
  return row_fate_texts()[static_cast<std::size_t>(fate)].loss;
}

double ImportedStream::lost_share() const {
  if (rows_read == 0) return 0;
  std::int64_t lost = 0;
  for (std::size_t fate = 0; fate < kRowFates; ++fate)
    if (loses(static_cast<RowFate>(fate))) lost += fates.rows[fate];
  return static_cast<double>(lost) / static_cast<double>(rows_read);
}

}  // namespace herr
