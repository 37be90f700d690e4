#include "scenes/gltf/format/rounded_number.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr double kAnything = std::numeric_limits<double>::max();

double rounding_at(double end, double width) {
  return kRounding * (end != 0 ? std::abs(end) : std::min(width, 1.0));
}

}  // namespace

bool RoundedNumbers::bring_into(double lowest, double highest, OutOfRange beyond, double& value) const {
  const double found = value, width = highest - lowest;
  value = std::clamp(value, lowest, highest);
  if (found == value || beyond == OutOfRange::clamped) return true;
  if (found > highest)
    return beyond == OutOfRange::clamped_above || found - highest <= rounding_at(highest, width);
  return lowest - found <= rounding_at(lowest, width);
}

void RoundedNumbers::remember(const JsonObject& object, const std::string& key, double found, double taken) {
  if (found == taken) return;
  if (count_++ > 0) return;
  first_ = "field " + printable((object.where().empty() ? "" : object.where() + ".") + key) + " is " +
           shown_number(found) + ", out of range; taken as " + shown_number(taken);
}

double RoundedNumbers::number_or(const JsonObject& object, const char* key, double lowest, double highest,
                                 double fallback, OutOfRange beyond) {
  if (!object.has(key)) return fallback;
  const double found = object.number(key, -kAnything, kAnything);
  double value = found;
  if (!bring_into(lowest, highest, beyond, value)) return object.number(key, lowest, highest);  // throws
  remember(object, key, found, value);
  return value;
}

std::vector<double> RoundedNumbers::numbers(const JsonObject& object, const char* key, std::size_t count,
                                            double lowest, double highest, OutOfRange beyond) {
  std::vector<double> values = object.numbers(key, count, -kAnything, kAnything);
  for (std::size_t i = 0; i < count; ++i) {
    const double found = values[i];
    if (!bring_into(lowest, highest, beyond, values[i]))
      return object.numbers(key, count, lowest, highest);  // throws
    remember(object, std::string(key) + "[" + std::to_string(i) + "]", found, values[i]);
  }
  return values;
}

glm::dvec3 RoundedNumbers::vec3_or(const JsonObject& object, const char* key, double lowest, double highest,
                                   const glm::dvec3& fallback, OutOfRange beyond) {
  if (!object.has(key)) return fallback;
  const std::vector<double> values = numbers(object, key, 3, lowest, highest, beyond);
  return {values[0], values[1], values[2]};
}

void RoundedNumbers::warn(std::vector<std::string>& warnings) const {
  if (count_ == 0) return;
  warnings.push_back(first_ + (count_ == 1   ? ""
                               : count_ == 2 ? ", and 1 number more"
                                             : ", and " + std::to_string(count_ - 1) + " numbers more"));
}

}  // namespace herr
