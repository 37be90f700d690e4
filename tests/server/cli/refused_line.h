// What a wrong command line ends with. Before: a test's arguments. After: the one line that names the flag.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/cli/command_line.h"
#include "server/process/exit_code.h"

namespace herr::test {

using Arguments = std::vector<std::string>;

// The one line that a wrong command line ends with; empty when it was accepted.
inline std::string complaint(const Arguments& arguments) {
  try {
    parse_command_line(arguments);
    return {};
  } catch (...) {
    std::string message;
    const int code = exit_code_of_current_exception(message);
    EXPECT_EQ(code, kExitUsage) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
}

}  // namespace herr::test
