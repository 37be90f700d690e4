// Files open only beneath their folder, whether the kernel walks the path or we resolve its links.
#include "sessions/files/contained_folder.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <string>

#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "tests/sessions/files/faulty_files.h"
#include "tests/temporary_folder.h"

namespace herr::test {
namespace {

namespace fs = std::filesystem;

// secret, shut/ (what must not be reached), and open/ with a file, a folder and links of every kind.
void fill(const fs::path& folder) {
  make_folders(folder / "open/inner");
  make_folders(folder / "shut");
  for (const char* name : {"secret", "shut/secret", "open/file", "open/inner/file"})
    write_whole_file(folder / name, std::string_view("x"));
  fs::create_symlink("../secret", folder / "open/link_out");
  fs::create_symlink(folder / "secret", folder / "open/absolute_link_out");
  fs::create_symlink("../shut", folder / "open/folder_link_out");
  fs::create_symlink("inner/file", folder / "open/link_in");
  fs::create_symlink("../open/file", folder / "open/link_out_and_in");
  fs::create_symlink("loop", folder / "open/loop");
  fs::create_symlink("open", folder / "link_to_open");
}

struct Case {
  std::string name;
  int error;
};

const Case kCases[] = {
    {"file", 0},
    {"inner/file", 0},
    {"./inner/../file", 0},
    {"link_in", 0},
    {"inner", 0},  // a folder opens; InputFile refuses it
    {"../secret", EXDEV},
    {"inner/../../secret", EXDEV},
    {"/etc/hostname", EXDEV},
    {"link_out", EXDEV},
    {"absolute_link_out", EXDEV},
    {"folder_link_out/secret", EXDEV},
    {"absent", ENOENT},
    {"file/below", ENOTDIR},
    {"loop", ELOOP},
    {std::string("file\0.png", 9), EINVAL},
};

TEST(ContainedFolder, OpensWhatIsBeneathAndNothingElse) {
  const TemporaryFolder folder;
  fill(folder.path());
  for (const char* root : {"open", "link_to_open"}) {
    const ContainedFolder contained(folder.path() / root);
    ASSERT_EQ(contained.error(), 0);
    for (const auto& [name, error] : kCases)
      EXPECT_EQ(contained.open(name).error, error) << root << " " << name;
    EXPECT_EQ(contained.open("link_out_and_in").error, EXDEV) << "the kernel stops at the way out";
  }
}

TEST(ContainedFolder, DoesSoOnAKernelWithoutOpenat2) {
  const TemporaryFolder folder;
  fill(folder.path());
  FaultyFiles old_kernel;
  old_kernel.forget_open_beneath();
  for (const char* root : {"open", "link_to_open"}) {
    const ContainedFolder contained(folder.path() / root);
    for (const auto& [name, error] : kCases)
      EXPECT_EQ(contained.open(name).error, error) << root << " " << name;
  }
}

TEST(ContainedFolder, IsNotFooledByAFolderWhoseNameGoesOn) {
  const TemporaryFolder folder;
  make_folders(folder.path() / "a");
  make_folders(folder.path() / "ab");
  write_whole_file(folder.path() / "ab/file", std::string_view("x"));
  for (const bool old : {false, true}) {
    FaultyFiles kernel;
    if (old) kernel.forget_open_beneath();
    EXPECT_EQ(ContainedFolder(folder.path() / "a").open("../ab/file").error, EXDEV) << old;
  }
}

TEST(ContainedFolder, FollowsNoLinkOfTheKernelToOpenFiles) {
  const ContainedFolder own("/proc/self");
  if (own.error() != 0) GTEST_SKIP() << "no /proc";
  EXPECT_EQ(own.open("root/etc/hostname").error, ELOOP);
  EXPECT_EQ(own.open("exe").error, ELOOP);
}

TEST(ContainedFolder, TellsWhenItIsNoFolderOrMissing) {
  const TemporaryFolder folder;
  fill(folder.path());
  EXPECT_EQ(ContainedFolder(folder.path() / "secret").error(), ENOTDIR);
  EXPECT_EQ(ContainedFolder(folder.path() / "absent").error(), ENOENT);
}

TEST(ContainedFolder, AsksAgainWhileSomebodyRenamesAndIsNoEndlessLoop) {
  const TemporaryFolder folder;
  fill(folder.path());
  const ContainedFolder contained(folder.path() / "open");
  struct Renaming : FileSystem {
    int left;
    explicit Renaming(int times) : left(times) { use_file_system(this); }
    ~Renaming() override { use_file_system(nullptr); }
    int open_beneath(int in, const char* name, int flags) override {
      return left-- > 0 ? -EAGAIN : FileSystem::open_beneath(in, name, flags);
    }
  };
  {
    Renaming twice(2);
    EXPECT_EQ(contained.open("file").error, 0);
  }
  Renaming for_ever(1 << 30);
  EXPECT_EQ(contained.open("file").error, EAGAIN);
}

TEST(ReadNamedFile, SaysWhoNamesWhatIsWrong) {
  const TemporaryFolder folder;
  fill(folder.path());
  write_whole_file(folder.path() / "open/empty", std::string_view(""));
  const fs::path owner = folder.path() / "open/model.gltf";
  const struct {
    std::string name, part;
    std::int64_t limit;
  } cases[] = {
      {"../secret", "names \"../secret\", which lies outside the folder of the file that names it; copy it",
       9},
      {"link_out", "lies outside the folder", 9},
      {"absent", "names \"absent\", which cannot be opened: No such file or directory", 9},
      {"inner", "which is a folder, not a file", 9},
      {"empty", "which is empty", 9},
      {"file", "which has 1 bytes, more than the limit of 0; split or shrink the model", 0},
  };
  for (const auto& [name, part, limit] : cases) {
    try {
      (void)read_named_file(owner, name, limit);
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find(owner.string() + ": names"), 0u) << error.what();
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(read_named_file(owner, "inner/file", 1), std::vector<unsigned char>{'x'});
}

}  // namespace
}  // namespace herr::test
