#include "server/output/frame_writer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "server/output/atomic_file.h"
#include "temporary_folder.h"

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
