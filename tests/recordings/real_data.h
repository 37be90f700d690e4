// Where other people's recordings and models lie. Before: $HERR_TEST_DATA, or the folder beside the source.
// After: tests, which are skipped where there is none.
#pragma once

#include <cstdlib>
#include <filesystem>

#include "tests/paths.h"

namespace herr::test {

// Empty where they are absent.
inline std::filesystem::path real_data() {
  const char* given = std::getenv("HERR_TEST_DATA");
  const std::filesystem::path folder = given != nullptr
                                           ? std::filesystem::path(given)
                                           : std::filesystem::path(source_dir()) / ".." / "shared" / "data";
  return std::filesystem::is_directory(folder / "sessions") ? std::filesystem::weakly_canonical(folder)
                                                            : std::filesystem::path();
}

}  // namespace herr::test
