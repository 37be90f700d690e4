#include "tests/paths.h"

namespace herr::test {

std::string source_dir() {
  return HERR_SOURCE_DIR;
}
std::string program_path() {
  return HERR_PROGRAM;
}

}  // namespace herr::test
