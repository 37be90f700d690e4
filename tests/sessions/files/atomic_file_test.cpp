#include "sessions/files/atomic_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

namespace herr {
namespace {

// Limits the size of every file that this process writes, as `ulimit -f` does, while it lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

std::string own_temporary_name(const std::string& name) {
  return name + ".tmp." + std::to_string(::getpid());
}

TEST(AtomicFile, AppearsUnderItsNameOnlyWithCommit) {
  const TemporaryFolder folder;
  {
    AtomicFile file(folder.path() / "a.txt");
    file.write("one ");
    file.write("two");
    EXPECT_EQ(folder.names(), std::vector<std::string>{own_temporary_name("a.txt")});
    file.commit();
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
  EXPECT_EQ(content_of(folder.path() / "a.txt"), "one two");
}

TEST(AtomicFile, LeavesNothingBehindWithoutCommit) {
  const TemporaryFolder folder;
  { AtomicFile(folder.path() / "a.txt").write("half a fi"); }
  EXPECT_TRUE(folder.names().empty());
}

TEST(AtomicFile, KeepsTheOldContentUntilTheNewOneIsComplete) {
  const TemporaryFolder folder;
  write_whole_file(folder.path() / "a.txt", std::string_view("old"));
  {
    AtomicFile file(folder.path() / "a.txt");
    file.write("new");
    EXPECT_EQ(content_of(folder.path() / "a.txt"), "old");
  }
  EXPECT_EQ(content_of(folder.path() / "a.txt"), "old");
  write_whole_file(folder.path() / "a.txt", std::string_view("new"));
  EXPECT_EQ(content_of(folder.path() / "a.txt"), "new");
}

TEST(AtomicFile, AFileOverTheSizeLimitFailsAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::string text(100'000, 'x');
  const FileSizeLimit limit(65'536);  // the first write comes back short, the second one fails
  try {
    write_whole_file(folder.path() / "big.txt", std::string_view(text));
    FAIL() << "the write was reported as done";
  } catch (const WriteError& error) {
    EXPECT_EQ(error.error_number(), EFBIG);
    EXPECT_NE(std::string(error.what()).find("big.txt: cannot write: "), std::string::npos) << error.what();
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(AtomicFile, AFullDiskFailsAndLeavesNothing) {
  const TemporaryFolder folder;
  if (::mount("none", folder.path().c_str(), "tmpfs", 0, "size=64k") != 0) {
    GTEST_SKIP() << "no right to mount a small disk";
  }
  int error_number = 0;
  try {
    write_whole_file(folder.path() / "big.txt", std::string_view(std::string(200'000, 'x')));
  } catch (const WriteError& error) {
    error_number = error.error_number();
  }
  const auto left = folder.names();
  ::umount(folder.path().c_str());
  EXPECT_EQ(error_number, ENOSPC);
  EXPECT_TRUE(left.empty());
}

TEST(AtomicFile, NeverTakesOverATemporaryFileThatExists) {
  const TemporaryFolder folder;
  const auto other = folder.path() / own_temporary_name("a.txt");
  write_whole_file(other, std::string_view("somebody else's"));
  EXPECT_THROW(AtomicFile(folder.path() / "a.txt"), WriteError);
  EXPECT_EQ(content_of(other), "somebody else's");
}

TEST(AtomicFile, AMissingFolderIsAWriteErrorWithTheFilesName) {
  const TemporaryFolder folder;
  try {
    write_whole_file(folder.path() / "none" / "a.txt", std::string_view("x"));
    FAIL();
  } catch (const WriteError& error) {
    EXPECT_EQ(error.error_number(), ENOENT);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST(AtomicFile, TemporaryNamesTellTheirProcess) {
  EXPECT_EQ(temporary_file_pid("frames.csv.tmp.123"), 123);
  EXPECT_EQ(temporary_file_pid("frames.csv.tmp."), 0);
  EXPECT_EQ(temporary_file_pid("frames.csv.tmp.12x"), 0);
  EXPECT_EQ(temporary_file_pid("frames.csv.tmp.-12"), 0);
  EXPECT_EQ(temporary_file_pid("frames.csv"), 0);
  EXPECT_EQ(temporary_file_pid(".tmp.12"), 0);
}

}  // namespace
}  // namespace herr
