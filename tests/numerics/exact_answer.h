// Answers that are known in closed form, as rows of a table: what is asked, and how far the renderer lies
// off. Before: scenes of tests/renderer. After: a test for each row, and the page MEASURED.md.
#pragma once

#include <ostream>
#include <span>

namespace herr::test {

struct ExactAnswer {
  const char* name;  // of its test, too: letters and digits
  const char* asks;
  double (*error)();
  double bound;
  const char* unit;        // of error and bound
  const char* bound_from;  // one sentence: why the bound is this
};

// In messages of a test that fails.
inline void PrintTo(const ExactAnswer& answer, std::ostream* out) {
  *out << answer.asks;
}

std::span<const ExactAnswer> furnace_answers();  // one .cpp for each
std::span<const ExactAnswer> light_answers();
std::span<const ExactAnswer> probe_answers();
std::span<const ExactAnswer> geometry_answers();

}  // namespace herr::test
