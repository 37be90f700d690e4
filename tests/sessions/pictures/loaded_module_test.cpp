#include "sessions/pictures/loaded_module.h"

#include <gtest/gtest.h>

#include <cstring>
#include <thread>

#include "sessions/pictures/picture_reader.h"

namespace herr {
namespace {

TEST(PictureModule, IsLookedForBesideTheProgramAndThenWhereItIsInstalled) {
  const auto places = picture_module_places("/opt/herr/bin");
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0], "/opt/herr/bin/herr_pictures.so");
  EXPECT_EQ(places[1], "/opt/herr/lib/herr/herr_pictures.so");
}

TEST(PictureModule, IsTheSameForEveryThread) {
  const PictureModule* seen[4] = {};
  std::vector<std::thread> threads;
  for (const PictureModule*& one : seen) threads.emplace_back([&one] { one = &picture_module(); });
  for (std::thread& thread : threads) thread.join();
  for (const PictureModule* one : seen) EXPECT_EQ(one, &picture_module());
  EXPECT_EQ(picture_module().version, kPictureModuleVersion);
  EXPECT_EQ(picture_module().table_bytes, sizeof(PictureModule));
}

TEST(PictureModule, ReadsNoFormatThatNobodyVerified) {
  for (const char* format : {"tiff", "webp", "hdr", "", "png;jpeg"})
    EXPECT_THROW(PictureReader(format, "II*\0 bytes of another kind"), std::runtime_error) << format;
}

TEST(PictureModule, SaysWhatIsWrongWithAPictureInPlainData) {
  PictureReader reader("openexr", "v/1\x01 and then nothing of sense");
  EXPECT_NE(reader.problem(), "");
  PictureProblem problem;
  PictureHeader header;
  EXPECT_EQ(picture_module().open("openexr", "", 0, &header, &problem), nullptr);
  EXPECT_EQ(problem.kind, PictureProblem::bad_picture);
  EXPECT_LT(std::strlen(problem.text), sizeof problem.text);
}

}  // namespace
}  // namespace herr
