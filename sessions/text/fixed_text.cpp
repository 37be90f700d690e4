#include "sessions/text/fixed_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace herr {

std::string fixed_text(double value, int decimals) {
  if (!std::isfinite(value)) return "n/a";
  // The longest fixed notation of a double has 309 digits before the point; 20 after it is the most we print.
  std::array<char, 352> buffer;
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals);
  return std::string(buffer.data(), result.ptr);
}

}  // namespace herr
