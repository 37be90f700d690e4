#include "server/output/frame_writer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "sessions/files/atomic_file.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

std::vector<std::uint8_t> bytes_of(int number) {
  return std::vector<std::uint8_t>(1000, static_cast<std::uint8_t>(number));
}

TEST(FrameWriter, WritesEverythingInOrderOfSubmission) {
  const TemporaryFolder folder;
  FrameWriter writer(3);
  for (int i = 0; i < 200; ++i) {
    std::vector<std::uint8_t> bytes = bytes_of(i);
    writer.submit(folder.path() / ("f" + std::to_string(i)), bytes);
    EXPECT_TRUE(bytes.empty());
  }
  writer.finish();
  EXPECT_EQ(writer.files_written(), 200);
  EXPECT_EQ(writer.bytes_written(), 200'000);
  EXPECT_EQ(folder.names().size(), 200u);
  EXPECT_EQ(content_of(folder.path() / "f77"), std::string(1000, static_cast<char>(77)));
}

TEST(FrameWriter, AFailedWriteStopsTheRunAndIsToldOnEveryCall) {
  const TemporaryFolder folder;
  FrameWriter writer(2);
  std::vector<std::uint8_t> good = bytes_of(1);
  writer.submit(folder.path() / "good", good);
  std::vector<std::uint8_t> bad = bytes_of(2);
  writer.submit(folder.path() / "missing" / "bad", bad);
  EXPECT_THROW(writer.finish(), WriteError);
  std::vector<std::uint8_t> late = bytes_of(3);
  EXPECT_THROW(writer.submit(folder.path() / "late", late), WriteError);
  EXPECT_THROW(writer.finish(), WriteError);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"good"});
  EXPECT_EQ(writer.files_written(), 1);
}

void submit_to(FrameWriter& writer, const std::filesystem::path& file) {
  std::filesystem::create_directories(file.parent_path());
  std::vector<std::uint8_t> bytes = bytes_of(1);
  writer.submit(file, bytes);
}

void wait_for_files(const FrameWriter& writer, std::int64_t count) {
  while (writer.files_written() < count) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

// A folder that is gone cannot be synced: the error shows that it was tried.
TEST(FrameWriter, FinishMakesTheNamesOfEveryFolderDurable) {
  const TemporaryFolder folder;
  FrameWriter writer(8);
  submit_to(writer, folder.path() / "frames" / "f0");
  submit_to(writer, folder.path() / "sheet");
  wait_for_files(writer, 2);
  std::filesystem::remove_all(folder.path() / "frames");
  try {
    writer.finish();
    FAIL() << "the folder of the first file was not synced";
  } catch (const WriteError& error) {
    EXPECT_NE(std::string(error.what()).find("frames: cannot open"), std::string::npos) << error.what();
  }
}

TEST(FrameWriter, EverySixtyFourFilesTheNamesOfEveryFolderBecomeDurable) {
  const TemporaryFolder folder;
  FrameWriter writer(64);
  submit_to(writer, folder.path() / "frames" / "f0");
  for (int i = 1; i < 63; ++i) submit_to(writer, folder.path() / ("f" + std::to_string(i)));
  wait_for_files(writer, 63);
  std::filesystem::remove_all(folder.path() / "frames");
  submit_to(writer, folder.path() / "f63");
  EXPECT_THROW(writer.finish(), WriteError);
  EXPECT_EQ(writer.files_written(), 63) << "the 64th file fails with the folders, before finish()";
}

TEST(FrameWriter, ARowIsWrittenAfterTheFilesBeforeItAndACheckpointAfterTheRow) {
  const TemporaryFolder folder;
  FrameWriter writer(1, AppendFile(folder.path() / "rows"));
  std::vector<std::uint8_t> bytes = bytes_of(1);
  writer.submit(folder.path() / "f0", bytes);
  writer.add_row("first\n");
  writer.checkpoint(folder.path() / "checkpoint", "one");
  writer.checkpoint(folder.path() / "checkpoint", "two");
  writer.finish();
  EXPECT_EQ(content_of(folder.path() / "rows"), "first\n");
  EXPECT_EQ(content_of(folder.path() / "checkpoint"), "two");
  EXPECT_EQ(writer.files_written(), 1);
  // A file that fails: neither the row that names it nor the checkpoint that counts on it appears.
  bytes = bytes_of(2);
  writer.submit(folder.path() / "missing" / "f1", bytes);
  EXPECT_THROW(
      {
        writer.add_row("second\n");
        writer.checkpoint(folder.path() / "checkpoint", "three");
        writer.finish();
      },
      WriteError);
  EXPECT_EQ(content_of(folder.path() / "rows"), "first\n");
  EXPECT_EQ(content_of(folder.path() / "checkpoint"), "two");
}

TEST(FrameWriter, EndsWithoutFinishWhenTheRunIsGivenUp) {
  const TemporaryFolder folder;
  {
    FrameWriter writer(8);
    for (int i = 0; i < 8; ++i) {
      std::vector<std::uint8_t> bytes = bytes_of(i);
      writer.submit(folder.path() / ("f" + std::to_string(i)), bytes);
    }
  }
  for (const std::string& name : folder.names())
    EXPECT_EQ(content_of(folder.path() / name).size(), 1000u) << name;
}

}  // namespace
}  // namespace herr
