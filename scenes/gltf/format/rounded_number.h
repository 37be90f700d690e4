// Numbers of a glTF that lie a hair outside their range, as exporters round them: a factor of 1.0000001, a
// cone of pi/2 as float. They are taken as the end of the range, and a warning says so; what lies further out
// stays an error. Before: strict_json. After: the readers of gltf/file.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sessions/files/strict_json.h"

namespace herr {

// What becomes of a number that lies further out than rounding explains.
enum class OutOfRange {
  refused,
  clamped_above,  // the end of the range where it is above: for what older files were allowed to write
  clamped         // the end of the range: for what other readers do not read at all
};

// 1e-4 of the end of a range; at an end of 0, of the range's width (of 1 where that is less).
inline constexpr double kRounding = 1e-4;

// Reads fields as JsonObject's readers of the same names do, and remembers what it had to take as another
// number. One for all fields of a kind; warn() afterwards.
class RoundedNumbers {
 public:
  double number_or(const JsonObject& object, const char* key, double lowest, double highest, double fallback,
                   OutOfRange beyond = OutOfRange::refused);
  std::vector<double> numbers(const JsonObject& object, const char* key, std::size_t count, double lowest,
                              double highest, OutOfRange beyond = OutOfRange::refused);
  glm::dvec3 vec3_or(const JsonObject& object, const char* key, double lowest, double highest,
                     const glm::dvec3& fallback, OutOfRange beyond = OutOfRange::refused);

  // One line for the first field and the number of others, none where every number was in its range.
  void warn(std::vector<std::string>& warnings) const;

 private:
  // False where the number is too far out.
  bool bring_into(double lowest, double highest, OutOfRange beyond, double& value) const;
  void remember(const JsonObject& object, const std::string& key, double found, double taken);

  std::string first_;
  std::size_t count_ = 0;
};

}  // namespace herr
