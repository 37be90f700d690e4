// Sets of picture formats as --format writes them.
#include "server/settings/picture_formats.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace herr {
namespace {

TEST(PictureFormatsTest, AreReadInAnyOrderAndToldInOne) {
  EXPECT_EQ(text_of(picture_formats_from("exr,png")), "png,exr");
  EXPECT_EQ(picture_formats_from("png,exr"), (PictureFormats{PictureFormat::exr, PictureFormat::png}));
  EXPECT_EQ(text_of(picture_formats_from("exr")), "exr");
  EXPECT_EQ(text_of(picture_formats_from("png, exr")), "png,exr") << "a blank after the comma";
  EXPECT_TRUE(picture_formats_from("none").empty());
  EXPECT_EQ(text_of({}), "none");
}

TEST(PictureFormatsTest, RefuseWhatIsUnknownEmptyRepeatedOrNoneBesideOthers) {
  for (const auto& [text, reason] : {std::pair{"jpg", "one of png, exr, none"},
                                     {"", "one of"},
                                     {"png,", "one of"},
                                     {"png,png", "named twice"},
                                     {"none,png", "beside a format"},
                                     {"exr,none", "beside a format"}}) {
    try {
      picture_formats_from(text);
      ADD_FAILURE() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << text << ": " << error.what();
    }
  }
}

}  // namespace
}  // namespace herr
