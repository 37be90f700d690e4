// Five pictures, three within 66 ms, then a second's pause, then two more, stamped in every way that there
// is.
#include "sessions/import/cameras/picture_stamps.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "sessions/files/input_error.h"
#include "sessions/import/cameras/exif_time.h"
#include "tests/sessions/import/cameras/exif_bytes.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using test::RecordedFolder;

constexpr TimeNs kMs = 1'000'000;
const std::vector<std::int64_t> kFiveMs{1750000000350, 1750000000383, 1750000000416, 1750000001416,
                                        1750000001449};

std::vector<TimeNs> five_ns() {
  std::vector<TimeNs> stamps;
  for (const std::int64_t ms : kFiveMs) stamps.push_back(ms * kMs);
  return stamps;
}

std::vector<TimeNs> stamps_of(const StampedPictures& stamped) {
  std::vector<TimeNs> stamps;
  for (const StampedPicture& picture : stamped.pictures) stamps.push_back(picture.stamp_ns);
  return stamps;
}

std::vector<std::string> names_of(const StampedPictures& stamped) {
  std::vector<std::string> names;
  for (const StampedPicture& picture : stamped.pictures) names.push_back(picture.file.filename().string());
  return names;
}

CameraPictures pictures_named(const RecordedFolder& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) folder.write_image("cam/" + name, 4, 3);
  return find_camera_pictures(folder / "cam");
}

void add_exif(const RecordedFolder& folder, const std::string& name, const std::string& tiff) {
  folder.write_image(name, 4, 3);
  std::ifstream file(folder / name, std::ios::binary);
  const std::string picture((std::istreambuf_iterator<char>(file)), {});
  file.close();
  folder.write(name, test::with_exif(picture, tiff));
}

std::string exif_at(const std::string& date, const std::string& sub_seconds, const std::string& offset) {
  std::vector<std::pair<int, std::string>> tags{{0x9003, date}};
  if (!offset.empty()) tags.emplace_back(0x9011, offset);
  if (!sub_seconds.empty()) tags.emplace_back(0x9291, sub_seconds);
  return test::exif_of(tags);
}

TEST(PictureStamps, NamesOfMillisecondsAreProposedAndRead) {
  const RecordedFolder folder;
  std::vector<std::string> names;
  for (const std::int64_t ms : kFiveMs) names.push_back(std::to_string(ms) + ".png");
  const CameraPictures pictures = pictures_named(folder, names);
  EXPECT_EQ(stamp_pattern_of(pictures), "{ms}");
  const StampedPictures stamped = stamps_from_names(pictures, "{ms}");
  EXPECT_EQ(stamps_of(stamped), five_ns());
  EXPECT_EQ(names_of(stamped), names);
  EXPECT_TRUE(stamped.remarks.empty());
}

TEST(PictureStamps, PatternsOfAllUnitsAreReadAndProposed) {
  struct Case {
    std::string pattern, name;
    TimeNs stamp_ns;
    bool proposed;
  };
  // 2016-12-13 21:21:13 UTC is 1481664073 s after 1970 (date -u -d ... +%s).
  const std::vector<Case> cases{
      {"{ns}", "1403636579763555584", 1403636579763555584, true},
      {"img-{us}", "img-1750000000350001", 1750000000350001000, true},
      {"{s}", "1750000000.35", 1750000000350000000, true},
      {"left_{s}", "left_1305031102.175304", 1305031102175304000, true},
      {"{*}_{s}", "214-1_86.385246", 86385246000, false},
      {"{*}-{ms}-{*}", "cam0-512-x", 512000000, false},
      {"{ms}{*}", "1750000000350_left", 1750000000350000000, false},
      {"{date}", "2016-12-13T21:21:13.011Z", 1481664073011000000, false},
      {"IMG_{date:%Y%m%d_%H%M%S%f}", "IMG_20161213_212113011", 1481664073011000000, false},
  };
  for (const Case& each : cases) {
    const RecordedFolder folder;
    const CameraPictures pictures = pictures_named(folder, {each.name + ".png"});
    SCOPED_TRACE(each.name);
    EXPECT_EQ(stamps_of(stamps_from_names(pictures, each.pattern)), std::vector<TimeNs>{each.stamp_ns});
    if (each.proposed) {
      EXPECT_EQ(stamp_pattern_of(pictures), each.pattern);
    }
  }
}

TEST(PictureStamps, ACounterBesideTheStampIsAnyNumber) {
  const RecordedFolder folder;
  const CameraPictures pictures = pictures_named(
      folder,
      {"rgb_8_1750000000350_left.png", "rgb_9_1750000000383_left.png", "rgb_10_1750000001416_left.png"});
  EXPECT_EQ(stamp_pattern_of(pictures), "rgb_{*}_{ms}_left");
  EXPECT_EQ(stamps_of(stamps_from_names(pictures, "rgb_{*}_{ms}_left")),
            (std::vector<TimeNs>{kFiveMs[0] * kMs, kFiveMs[1] * kMs, kFiveMs[3] * kMs}));
}

TEST(PictureStamps, NoPatternIsProposedForNumbersThatAreNoTimes) {
  for (const std::vector<std::string>& names : {std::vector<std::string>{"1.png", "2.png"},
                                                {"000000001234.png"},
                                                {"17500000003501.png"},
                                                {"a1750000000350.png", "b1750000000383.png"},
                                                {"1750000000350.png", "notes.png"}}) {
    const RecordedFolder folder;
    EXPECT_EQ(stamp_pattern_of(pictures_named(folder, names)), std::nullopt) << names.front();
  }
}

TEST(PictureStamps, NamesThatDoNotFitAndRepeatedStampsAreLeftOutAndSaid) {
  const RecordedFolder folder;
  const StampedPictures stamped = stamps_from_names(
      pictures_named(folder, {"a_20.png", "b_10.png", "c_20.png", "thumb.png"}), "{*}_{ms}");
  EXPECT_EQ(names_of(stamped), (std::vector<std::string>{"b_10.png", "a_20.png"}));
  EXPECT_EQ(stamped.without_stamp, 1);
  EXPECT_EQ(stamped.repeated_stamps, 1);
  ASSERT_EQ(stamped.remarks.size(), 2u);
  EXPECT_EQ(stamped.remarks[0],
            "1 of 4 pictures do not fit the pattern '{*}_{ms}' of names and are left out (the first is "
            "'thumb.png')");
  EXPECT_EQ(
      stamped.remarks[1],
      "1 of 4 pictures repeat the stamp of another and are left out ('c_20.png' has that of 'a_20.png')");
}

TEST(PictureStamps, APatternThatIsNoneOrFitsNothingIsRefused) {
  const RecordedFolder folder;
  const CameraPictures pictures = pictures_named(folder, {"1.png", "1a.png"});
  EXPECT_INPUT_ERROR(stamps_from_names(pictures, "frame"),
                     "the pattern 'frame' of the pictures' names has no {s}");
  EXPECT_INPUT_ERROR(stamps_from_names(pictures, "{ms}{ns}"), "has two stamps");
  EXPECT_INPUT_ERROR(stamps_from_names(pictures, "{min}"), "unknown {min}");
  EXPECT_INPUT_ERROR(stamps_from_names(pictures, "{ms"), "open brace");
  EXPECT_INPUT_ERROR(stamps_from_names(pictures, "{*}{*}{*}{ms}"), "more than two {*}");
  EXPECT_INPUT_ERROR(stamps_from_names(pictures, "x{ms}"),
                     "holds 2 pictures, which do not fit the pattern 'x{ms}' of names");
  EXPECT_INPUT_ERROR(stamps_from_names(pictures, "{s}{*}"),
                     "whole seconds only, and several pictures share one");
}

TEST(PictureStamps, DatesInNamesWithoutAZoneAreSaidToBeTakenAsUtc) {
  const RecordedFolder folder;
  const CameraPictures pictures = pictures_named(folder, {"20161213_212113.png"});
  const StampedPictures utc = stamps_from_names(pictures, "{date:%Y%m%d_%H%M%S}");
  ASSERT_EQ(utc.assumed.size(), 1u);
  EXPECT_PRED2(test::holds, utc.assumed[0], "taken as UTC");
  // An hour east of Greenwich the clock shows 21:21:13 an hour earlier.
  const StampedPictures east = stamps_from_names(pictures, "{date:%Y%m%d_%H%M%S}", 60);
  EXPECT_TRUE(east.assumed.empty());
  EXPECT_EQ(utc.pictures[0].stamp_ns - east.pictures[0].stamp_ns, 3'600'000'000'000);
}

// 1750000000 s is 2025-06-15 15:06:40 UTC (date -u -d @1750000000).
TEST(PictureStamps, ExifOfJpegAndPngGivesItsOwnStamps) {
  for (const std::string extension : {".jpg", ".png"}) {
    const RecordedFolder folder;
    add_exif(folder, "1" + extension, exif_at("2025:06:15 17:06:40", "350", "+02:00"));
    add_exif(folder, "2" + extension, exif_at("2025:06:15 17:06:40", "383", "+02:00"));
    add_exif(folder, "3" + extension, exif_at("2025:06:15 17:06:40", "416", "+02:00"));
    add_exif(folder, "4" + extension, exif_at("2025:06:15 15:06:41", "416", "Z"));
    add_exif(folder, "5" + extension, exif_at("2025:06:15 10:06:41", "449000", "-05:00"));
    const StampedPictures stamped = stamps_from_exif(find_camera_pictures(folder.path()), {});
    EXPECT_EQ(stamps_of(stamped), five_ns()) << extension;
    EXPECT_TRUE(stamped.remarks.empty());
    EXPECT_EQ(stamped.source, "EXIF");
  }
}

TEST(PictureStamps, ExifWithoutAZoneNeedsOne) {
  const RecordedFolder folder;
  add_exif(folder, "1.jpg", exif_at("2025:06:15 17:06:40", "35", ""));
  const CameraPictures pictures = find_camera_pictures(folder.path());
  EXPECT_INPUT_ERROR(stamps_from_exif(pictures, {}),
                     "without a zone ('2025:06:15 17:06:40'); give --camera-zone");
  EXPECT_EQ(stamps_of(stamps_from_exif(pictures, 120)), std::vector<TimeNs>{kFiveMs[0] * kMs});
}

TEST(PictureStamps, WholeSecondsOfSeveralPicturesASecondAreNoStamps) {
  const RecordedFolder folder;
  add_exif(folder, "1.jpg", exif_at("2025:06:15 15:06:40", "", "Z"));
  add_exif(folder, "2.jpg", exif_at("2025:06:15 15:06:41", "", "Z"));
  const StampedPictures slow = stamps_from_exif(find_camera_pictures(folder.path()), {});
  EXPECT_EQ(slow.pictures.size(), 2u);
  ASSERT_EQ(slow.remarks.size(), 1u);
  EXPECT_PRED2(test::holds, slow.remarks[0], "2 of 2 pictures have whole seconds only in EXIF");
  add_exif(folder, "3.jpg", exif_at("2025:06:15 15:06:41", "", "Z"));
  EXPECT_INPUT_ERROR(stamps_from_exif(find_camera_pictures(folder.path()), {}),
                     "3.jpg: the EXIF time has whole seconds only, and several pictures share one");
}

TEST(PictureStamps, PicturesWithoutExifAreLeftOutAndSaid) {
  const RecordedFolder folder;
  add_exif(folder, "1.jpg", exif_at("2025:06:15 15:06:40", "350", "Z"));
  add_exif(folder, "2.jpg", exif_at("0000:00:00 00:00:00", "", ""));
  folder.write_image("3.jpg", 4, 3);
  const StampedPictures stamped = stamps_from_exif(find_camera_pictures(folder.path()), {});
  EXPECT_EQ(names_of(stamped), std::vector<std::string>{"1.jpg"});
  EXPECT_EQ(stamped.without_stamp, 2);
  const RecordedFolder none;
  none.write_image("3.png", 4, 3);
  EXPECT_INPUT_ERROR(stamps_from_exif(find_camera_pictures(none.path()), {}), "have no EXIF time");
}

// A picture of 4 x 4 pixels that exiv2 0.27.6 gave the date: it writes no eXIf chunk but hexadecimal digits
// into a compressed text chunk, as ImageMagick does.
TEST(ExifTime, IsReadFromTheTextChunkThatExiv2Writes) {
  const std::string hex =
      "89504e470d0a1a0a0000000d494844520000000400000004080200000026930929000000877a5458745261772070726f"
      "66696c6520747970652065786966000078da558ccb0d03300843ef4cd111cc27248c934aadd40d3a7e43e0524b80f320"
      "a6d7f7f3a6478a2164632e0f771c5958c83e66a1c480c79ab0f2176dfc4bb30204394b2b663d9903c931eb3d3a3838e4"
      "f2be53d1a19d470db25cf7997cba2a4b3abb64dc9ed9cfdea3bed30f27f42c37bfc08f300000000e49444154789c6388"
      "42020cc47100b70310e14e3179cb0000000049454e44ae426082";
  std::string png;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    png += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  const RecordedFolder folder;
  folder.write("1.png", png);
  const auto time = read_exif_time(folder / "1.png");
  ASSERT_TRUE(time);
  EXPECT_EQ(time->date, "2026:01:31 14:05:09");
  EXPECT_EQ(time->sub_seconds, "250");
  EXPECT_EQ(time->offset, "+01:00");
  // Cut or damaged anywhere, it is none or is refused, never more than the file.
  for (std::size_t i = 41; i + 12 < png.size(); i += 7) {
    std::string damaged = png;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x55);
    folder.write("2.png", damaged);
    try {
      (void)read_exif_time(folder / "2.png");
    } catch (const InputError&) {
      continue;
    }
  }
}

TEST(ExifTime, BothByteOrdersAreReadAndNothingBeyondTheEnd) {
  for (const bool big_endian : {false, true}) {
    const std::string tiff = test::exif_of(
        {{0x9003, "2026:01:31 14:05:09"}, {0x9011, "+01:00"}, {0x9291, "7"}, {0x9292, "9"}}, big_endian);
    const auto time = exif_time_in(tiff, "a.jpg");
    ASSERT_TRUE(time);
    EXPECT_EQ(time->date, "2026:01:31 14:05:09");
    EXPECT_EQ(time->sub_seconds, "7");
    EXPECT_EQ(time->offset, "+01:00");
    // Every cut leaves less: an error or no time, never a text from behind the end.
    for (std::size_t size = 0; size < tiff.size(); ++size)
      EXPECT_INPUT_ERROR(exif_time_in(std::string(tiff, 0, size), "a.jpg"), "a.jpg: has ") << size;
  }
}

TEST(ExifTime, OffsetsThatPointAnywhereAreRefused) {
  const std::string tiff = test::exif_of({{0x9003, "2026:01:31 14:05:09"}});
  for (std::size_t at = 0; at < tiff.size(); ++at) {
    for (const char byte : {'\x00', '\x7f', '\xff'}) {
      std::string damaged = tiff;
      damaged[at] = byte;
      try {
        exif_time_in(damaged, "a.jpg");
      } catch (const InputError& error) {
        EXPECT_PRED2(test::holds, error.what(), "a.jpg: has ");
      }
    }
  }
  std::string far = tiff;
  far.replace(4, 4, "\xff\xff\xff\xff");
  EXPECT_INPUT_ERROR(exif_time_in(far, "a.jpg"), "point outside themselves");
}

}  // namespace
}  // namespace herr
