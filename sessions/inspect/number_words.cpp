#include "sessions/inspect/number_words.h"

#include "sessions/text/fixed_text.h"

namespace herr {

std::string milliseconds(TimeNs ns) {
  return fixed_text(static_cast<double>(ns) * 1e-6, 1) + " ms";
}

std::string percentage(std::int64_t part, std::int64_t all) {
  return fixed_text(100 * static_cast<double>(part) / static_cast<double>(all), 1) + " %";
}

std::string counted(std::int64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace herr
