#include "server/process/exit_code.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>

#include "sessions/files/atomic_file.h"

namespace herr {
namespace {

int exit_code_of_failed_write(int error_number) {
  try {
    throw WriteError("out/frames.csv", "create", error_number);
  } catch (...) {
    std::string message;
    return exit_code_of_current_exception(message);
  }
}

TEST(ExitCode, AFolderThatMayNotBeWrittenToIsAWrongCommandLine) {
  // Trying again will not help; another --out will.
  for (const int error_number : {EACCES, EPERM, EROFS}) {
    EXPECT_EQ(exit_code_of_failed_write(error_number), kExitUsage) << error_number;
  }
}

TEST(ExitCode, ADiskThatIsFullOrFailsIsTemporary) {
  for (const int error_number : {ENOSPC, EDQUOT, EFBIG, EIO, EMFILE}) {
    EXPECT_EQ(exit_code_of_failed_write(error_number), kExitTemporary) << error_number;
  }
}

TEST(ExitCode, ASignalIsWorseThanAllElse) {
  EXPECT_EQ(worse_exit_code(kExitSignalBase + 2, kExitInternal), 130);
  EXPECT_EQ(worse_exit_code(kExitDone, kExitSignalBase + 15), 143);
}

}  // namespace
}  // namespace herr
