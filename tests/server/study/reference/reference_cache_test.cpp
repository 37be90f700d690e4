// References on disk: what is stored is loaded bit for bit, and what is damaged is none.
#include "server/study/reference/reference_cache.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

#include "renderer/viewport_image.h"
#include "server/output/srgb_table.h"
#include "tests/renderer/test_scenes.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

// Half floats of every kind but NaN.
ReferenceHalves some_halves(const DisplayProfile& profile, unsigned seed) {
  std::mt19937 engine(seed);
  ReferenceHalves halves;
  for (auto& half : halves.half) {
    for (const Viewport& v : profile.viewports) {
      LinearPicture picture{v.width_px, v.height_px, {}};
      for (auto& plane : picture.plane) {
        while (plane.size() < picture.pixels()) {
          const auto bits = static_cast<std::uint16_t>(engine());
          if ((bits & 0x7c00) != 0x7c00) plane.push_back(float_from_half(bits));
        }
      }
      half.push_back(std::move(picture));
    }
  }
  halves.passes = 12, halves.most_passes = 40, halves.goal_met = true, halves.seconds = 2.5;
  return halves;
}

class ReferenceCacheTest : public ::testing::Test {
 protected:
  void expect_loaded(ReferenceCache& cache, const std::string& key, const ReferenceHalves& stored) const {
    const std::optional<ReferenceHalves> loaded = cache.load(key, profile_);
    ASSERT_TRUE(loaded) << cache.remark();
    EXPECT_EQ(cache.remark(), "");
    EXPECT_EQ(loaded->passes, stored.passes);
    EXPECT_EQ(loaded->most_passes, stored.most_passes);
    EXPECT_EQ(loaded->goal_met, stored.goal_met);
    EXPECT_EQ(loaded->seconds, stored.seconds);
    for (std::size_t h = 0; h < 2; ++h) {
      ASSERT_EQ(loaded->half[h].size(), stored.half[h].size());
      for (std::size_t v = 0; v < stored.half[h].size(); ++v) {
        EXPECT_EQ(loaded->half[h][v].plane, stored.half[h][v].plane);
      }
    }
  }
  std::filesystem::path only_file() const {
    const std::vector<std::string> names = folder_.names();
    EXPECT_EQ(names.size(), 1u);
    return folder_.path() / names.at(0);
  }
  std::string bytes() const {
    std::ifstream in(only_file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  const DisplayProfile profile_ = test::small_profile(8, 10, 6);
  TemporaryFolder folder_;
};

TEST_F(ReferenceCacheTest, WhatIsStoredIsLoadedBitForBit) {
  ReferenceCache cache(folder_.path());
  const ReferenceHalves one = some_halves(profile_, 1), other = some_halves(profile_, 2);
  const std::string key = "frame 7; \"quoted\"\n; light_samples 16";
  cache.store(key, one);
  cache.store("frame 8", other);
  expect_loaded(cache, key, one);
  expect_loaded(cache, "frame 8", other);
  EXPECT_EQ(folder_.names().size(), 2u);
  ReferenceHalves unmet = other;
  unmet.goal_met = false, unmet.passes = 3;
  cache.store("frame 8", unmet);  // replaced
  expect_loaded(cache, "frame 8", unmet);
}

TEST_F(ReferenceCacheTest, AnotherKeyFindsNone) {
  ReferenceCache cache(folder_.path());
  EXPECT_FALSE(cache.load("frame 7", profile_));
  cache.store("frame 7", some_halves(profile_, 1));
  EXPECT_FALSE(cache.load("frame 8", profile_));
  EXPECT_EQ(cache.remark(), "");
  // Were both keys of one name, the key within the file tells.
  const std::filesystem::path file = only_file();
  std::string text = bytes();
  text.replace(text.find("frame 7"), 7, "frame 9");
  write_text(file, text);
  EXPECT_FALSE(cache.load("frame 7", profile_));
  EXPECT_EQ(cache.remark(), "");
}

TEST_F(ReferenceCacheTest, ADamagedFileIsToldOfAndMadeAgain) {
  ReferenceCache cache(folder_.path());
  const ReferenceHalves halves = some_halves(profile_, 3);
  cache.store("frame 7", halves);
  const std::filesystem::path file = only_file();
  const std::string whole = bytes();
  std::string flipped = whole;
  flipped.back() = static_cast<char>(flipped.back() ^ 1);
  std::string headless = whole;
  headless[0] = 'x';
  for (const std::string& damaged : {flipped, headless, whole.substr(0, whole.size() - 1), whole + "x",
                                     whole.substr(0, 20), std::string()}) {
    write_text(file, damaged);
    EXPECT_FALSE(cache.load("frame 7", profile_));
    EXPECT_NE(cache.remark().find(file.filename().string()), std::string::npos) << cache.remark();
  }
  cache.store("frame 7", halves);
  expect_loaded(cache, "frame 7", halves);
  // Of a display with other viewports.
  EXPECT_FALSE(cache.load("frame 7", test::small_profile(8, 10, 8)));
  EXPECT_NE(cache.remark(), "");
}

}  // namespace
}  // namespace herr
