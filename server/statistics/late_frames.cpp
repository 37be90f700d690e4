#include "server/statistics/late_frames.h"

#include <cstdint>
#include <utility>

namespace herr {

std::string causes_text(const RunStatistics& statistics) {
  std::string text;
  for (const auto& [count, of] :
       {std::pair<std::int64_t, const char*>{statistics.missed_by_machine, "machine"},
        {statistics.missed_by_work, "work"},
        {statistics.missed_by_both, nullptr}}) {
    if (count == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(count) +
            (of == nullptr ? std::string(" for both") : std::string(" for the ") + of);
  }
  return text.empty() ? text : " (" + text + ")";
}

}  // namespace herr
