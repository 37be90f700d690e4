#include "server/process/version.h"

namespace herr {

const char* program_version() {
  return HERR_VERSION;
}

const char* program_with_version() {
  return "herr " HERR_VERSION;
}

}  // namespace herr
