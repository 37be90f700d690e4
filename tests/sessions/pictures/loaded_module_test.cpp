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
  for (const char* format : {"tiff", "webp", "", "png;jpeg"})
    EXPECT_THROW(PictureReader(format, "II*\0 bytes of another kind"), std::runtime_error) << format;
}

TEST(PictureModule, SaysWhatIsWrongWithAPictureInPlainData) {
  PictureReader reader("jpeg", "\xff\xd8\xff and then nothing of sense");
  EXPECT_NE(reader.problem(), "");
  PictureProblem problem;
  PictureHeader header;
  EXPECT_EQ(picture_module().open("png", "", 0, &header, &problem), nullptr);
  EXPECT_EQ(problem.kind, PictureProblem::bad_picture);
  EXPECT_LT(std::strlen(problem.text), sizeof problem.text);
}

struct Sink {
  std::size_t room = 0, taken = 0;
};

bool take(void* user, const void*, std::size_t count) noexcept {
  auto& sink = *static_cast<Sink*>(user);
  if (sink.taken + count > sink.room) return false;
  sink.taken += count;
  return true;
}

TEST(PictureModule, TellsThatAPngFoundNoRoomWhereverThatHappens) {
  const std::vector<std::uint8_t> values(3 * 64 * 64, 77);
  Sink sink{std::size_t{1} << 20};
  const PngRequest request{64, 64, 3, 1, values.data(), &sink, take};
  PictureProblem problem;
  ASSERT_TRUE(picture_module().encode_png(&request, &problem)) << problem.text;
  const std::size_t whole = sink.taken;
  for (std::size_t room = 0; room < whole; room += 7) {
    sink = {room};
    problem = {};
    EXPECT_FALSE(picture_module().encode_png(&request, &problem)) << room;
    EXPECT_EQ(problem.kind, PictureProblem::out_of_memory) << room;
  }
}

}  // namespace
}  // namespace herr
