#include "sessions/import/import_report.h"

namespace herr {

double ImportedStream::lost_share() const {
  if (rows_read == 0) return 0;
  std::int64_t lost = 0;
  for (std::size_t fate = 0; fate < kRowFates; ++fate)
    if (row_fate_texts()[fate].loss) lost += fates.rows[fate];
  return static_cast<double>(lost) / static_cast<double>(rows_read);
}

}  // namespace herr
