// What a test does without a tool that it needs: elsewhere it is skipped; where HERR_TOOLS_INSTALLED is set,
// as .ci/run does after scripts/install-packages --tests, it fails, so that no test is lost silently.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

#define HERR_MISSING_TOOL(reason)                              \
  do {                                                         \
    if (std::getenv("HERR_TOOLS_INSTALLED") != nullptr)        \
      FAIL() << "HERR_TOOLS_INSTALLED is set, but " << reason; \
    GTEST_SKIP() << reason;                                    \
  } while (false)
