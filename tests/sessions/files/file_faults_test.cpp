// Every call that a write makes fails once, with every error that disks give: what stands under a final name
// is whole, and the error is the one that the disk gave.
#include <gtest/gtest.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "sessions/files/append_file.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folder_lock.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "tests/sessions/files/faulty_files.h"
#include "tests/temporary_folder.h"

namespace herr::test {
namespace {

constexpr int kDiskErrors[] = {ENOSPC, EDQUOT, EIO, EROFS};

// How a step of a write is called in its message.
std::string step_of(FileCall call) {
  return call == FileCall::open ? "create" : name_of(call);
}

TEST(FileFaults, AWholeFileIsTheNewOneOrTheOldOneWhicheverCallFails) {
  const std::string old_text(3000, 'o'), new_text(5000, 'n');
  int failures = 0;
  for (const FileCall call :
       {FileCall::open, FileCall::write, FileCall::sync, FileCall::close, FileCall::rename}) {
    for (const int error : kDiskErrors) {
      for (int n = 0;; ++n) {
        const TemporaryFolder folder;
        const auto file = folder.path() / "a";
        write_whole_file(file, std::string_view(old_text));
        FaultyFiles faults;
        faults.transfer_at_most(1000);
        faults.fail_from(call, n, error);
        const std::string shown = std::string(name_of(call)) + " " + std::to_string(n);
        try {
          write_whole_file(file, std::string_view(new_text));
          EXPECT_FALSE(faults.has_failed()) << shown << " failed and nobody told";
          EXPECT_EQ(content_of(file), new_text) << shown;
        } catch (const WriteError& told) {
          EXPECT_EQ(told.error_number(), error) << shown;
          const std::string message = told.what();
          EXPECT_NE(message.find("a: cannot " + step_of(call) + ": "), std::string::npos) << message;
          EXPECT_EQ(content_of(file), old_text) << shown;
          ++failures;
        }
        EXPECT_EQ(folder.names(), std::vector<std::string>{"a"}) << shown << " left something behind";
        EXPECT_TRUE(faults.renamed_before_sync().empty());
        if (!faults.has_failed()) break;
      }
    }
  }
  // 5 writes of 1000 bytes, and one call of each other kind, with four errors each.
  EXPECT_EQ(failures, 4 * (5 + 4));
}

TEST(FileFaults, RowsAreWholeWhicheverWriteFails) {
  for (int n = 0; n < 20; ++n) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "rows";
    FaultyFiles faults;
    AppendFile rows(file);
    rows.append("first row\n");
    rows.sync();
    faults.transfer_at_most(7);  // so that every row takes several writes
    faults.fail_from(FileCall::write, n, ENOSPC);
    rows.append("second row\nthird row\n");
    try {
      rows.finish();
      EXPECT_FALSE(faults.has_failed());
    } catch (const WriteError& told) {
      EXPECT_EQ(told.error_number(), ENOSPC);
    }
    const std::string text = content_of(file);
    EXPECT_TRUE(std::string("first row\nsecond row\nthird row\n").starts_with(text)) << text;
    EXPECT_TRUE(text.ends_with('\n')) << "a row was torn: " << text;
    if (!faults.has_failed()) return;
  }
  FAIL() << "the loop never came to its end";
}

TEST(FileFaults, RowsTellOfASyncACloseAndACutThatFail) {
  for (const FileCall call : {FileCall::sync, FileCall::close, FileCall::truncate, FileCall::open}) {
    const TemporaryFolder folder;
    FaultyFiles faults;
    faults.fail_from(call, 0, EIO);
    try {
      AppendFile rows(folder.path() / "rows", 0);
      rows.append("row\n");
      rows.finish();
      ADD_FAILURE() << name_of(call) << " failed and nobody told";
    } catch (const WriteError& told) {
      EXPECT_EQ(told.error_number(), EIO);
    }
  }
}

TEST(FileFaults, PartialAndInterruptedTransfersAreFinished) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 1000; ++i) text += std::to_string(i) + ' ';
  FaultyFiles faults;
  faults.transfer_at_most(11);
  faults.interrupt();
  write_whole_file(folder.path() / "a", std::string_view(text));
  EXPECT_EQ(read_whole_file(folder.path() / "a", 1 << 20), text);
  EXPECT_GT(faults.calls(FileCall::write), static_cast<int>(text.size()) / 11);
  EXPECT_GT(faults.calls(FileCall::read), static_cast<int>(text.size()) / 11);
}

TEST(FileFaults, ADiskThatCannotReadIsAnInputErrorAndAShortMachineIsNot) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a";
  write_whole_file(file, std::string_view("text"));
  FaultyFiles faults;
  faults.fail_from(FileCall::read, 0, EIO);
  try {
    read_whole_file(file, 100);
    ADD_FAILURE() << "the read failed and nobody told";
  } catch (const InputError& told) {
    EXPECT_EQ(told.problem(), "cannot be read: Input/output error");
  }
  for (const int shortage : {EMFILE, ENFILE, ENOMEM}) {
    faults.fail_from(FileCall::open, 0, shortage);
    try {
      read_whole_file(file, 100);
      ADD_FAILURE() << "the opening failed and nobody told";
    } catch (const std::system_error& told) {
      EXPECT_EQ(told.code().value(), shortage);
    }
  }
}

TEST(FileFaults, OfFoldersAreHandedOn) {
  const TemporaryFolder folder;
  FaultyFiles faults;
  faults.fail_from(FileCall::make_folder, 1, ENOSPC);
  EXPECT_EQ(make_folders(folder.path() / "a/b").value(), ENOSPC);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
  std::error_code error;
  faults.fail_from(FileCall::list, 0, EIO);
  EXPECT_TRUE(list_folder(folder.path(), error).empty());
  EXPECT_EQ(error.value(), EIO);
  faults.fail_from(FileCall::remove, 0, EACCES);
  EXPECT_EQ(remove_tree(folder.path() / "a").value(), EACCES);
  faults.fail_from(FileCall::sync, 0, EIO);
  EXPECT_THROW(sync_folder(folder.path()), WriteError);
  faults.fail_from(FileCall::lock, 0, EWOULDBLOCK);
  EXPECT_FALSE(FolderLock::take(folder.path()));
  faults.fail_from(FileCall::lock, 0, ENOLCK);
  EXPECT_TRUE(FolderLock::take(folder.path())) << "where the file system knows no locks there are none";
}

}  // namespace
}  // namespace herr::test
