// A replay's files while the disk fails: whichever call it is, no half of a picture, a row or a checkpoint
// stands under its name, no row names a picture that is not there, and the error told is the disk's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "server/output/frame_writer.h"
#include "sessions/files/append_file.h"
#include "tests/sessions/files/faulty_files.h"
#include "tests/temporary_folder.h"

namespace herr::test {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 3;
constexpr std::size_t kPictureBytes = 1000;

std::string picture_name(int frame) {
  return "frame_" + std::to_string(frame);
}

// As a replay does it: the header, then for each frame its picture, its row, and a checkpoint.
void write_frames(const fs::path& folder) {
  AppendFile rows(folder / "frames.csv");
  rows.append("frame\n");
  rows.flush();
  FrameWriter writer(8, std::move(rows));
  for (int frame = 0; frame < kFrames; ++frame) {
    std::vector<std::uint8_t> bytes(kPictureBytes, static_cast<std::uint8_t>('a' + frame));
    writer.submit(folder / picture_name(frame), bytes);
    writer.add_row(std::to_string(frame) + "\n");
    writer.checkpoint(folder / "checkpoint", "after " + std::to_string(frame));
  }
  writer.finish();
}

int lines_in(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

// What the folder holds is true, whatever came before.
void expect_whole(const fs::path& folder, const std::vector<std::string>& names, const std::string& shown) {
  int pictures = 0;
  for (const std::string& name : names) {
    EXPECT_EQ(name.find(".tmp."), std::string::npos) << shown << " left " << name;
    if (!name.starts_with("frame_")) continue;
    const int frame = name.back() - '0';
    EXPECT_EQ(content_of(folder / name), std::string(kPictureBytes, static_cast<char>('a' + frame))) << shown;
    ++pictures;
  }
  int rows = 0;
  if (fs::exists(folder / "frames.csv")) {
    const std::string text = content_of(folder / "frames.csv");
    EXPECT_TRUE(std::string("frame\n0\n1\n2\n").starts_with(text)) << shown << ": " << text;
    EXPECT_TRUE(text.empty() || text.ends_with('\n')) << shown << ": a row is torn: " << text;
    rows = std::max(lines_in(text) - 1, 0);
  }
  EXPECT_LE(rows, pictures) << shown << ": a row names a picture that is not there";
  if (!fs::exists(folder / "checkpoint")) return;
  const std::string checkpoint = content_of(folder / "checkpoint");
  ASSERT_EQ(checkpoint.size(), std::string("after 0").size()) << shown << ": " << checkpoint;
  EXPECT_LE(checkpoint.back() - '0' + 1, rows) << shown << ": a checkpoint counts on a row that is not there";
}

TEST(FrameWriterFaults, LeaveWholeFilesAndTheRightErrorWhicheverCallFails) {
  int failures = 0;
  for (const FileCall call :
       {FileCall::open, FileCall::write, FileCall::sync, FileCall::close, FileCall::rename}) {
    for (const int error : {ENOSPC, EIO}) {
      for (int n = 0;; ++n) {
        const TemporaryFolder folder;
        const std::string shown = std::string(name_of(call)) + " " + std::to_string(n);
        std::optional<int> told;
        FaultyFiles faults;
        faults.fail_from(call, n, error);
        try {
          write_frames(folder.path());
        } catch (const WriteError& failure) {
          told = failure.error_number();
        }
        const bool failed = faults.has_failed();
        expect_whole(folder.path(), folder.names(), shown);
        EXPECT_TRUE(faults.renamed_before_sync().empty()) << shown;
        if (!failed) {
          EXPECT_FALSE(told) << shown;
          break;
        }
        // Only of a close is it known, at the end of a folder's sync, that nothing is lost.
        if (call != FileCall::close) {
          EXPECT_EQ(told, error) << shown;
        }
        ++failures;
        ASSERT_LT(n, 100) << "the loop never came to its end";
      }
    }
  }
  EXPECT_GT(failures, 60);
}

}  // namespace
}  // namespace herr::test
