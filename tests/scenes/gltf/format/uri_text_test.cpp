// URIs of glTF files: escapes, plus signs, and data in the URI itself.
#include "scenes/gltf/format/uri_text.h"

#include <gtest/gtest.h>

namespace herr::test {
namespace {

std::string text_of(const UriData& data) {
  return {data.bytes.begin(), data.bytes.end()};
}

// RFC 3986: two hexadecimal digits after '%' are a byte; '+' stands for itself, unlike in the forms of web
// pages.
TEST(UriText, EscapesAreBytesAndEverythingElseIsItself) {
  EXPECT_EQ(percent_decoded("a+b%23c%20d.bin"), "a+b#c d.bin");
  EXPECT_EQ(percent_decoded("%e2%9D%a4.png"), "\xe2\x9d\xa4.png");
  EXPECT_EQ(percent_decoded("100%.bin"), "100%.bin");
  EXPECT_EQ(percent_decoded("5%zz%4"), "5%zz%4");
  EXPECT_EQ(percent_decoded("%%41"), "%A");
  EXPECT_EQ(percent_decoded("%2541"), "%41");
  EXPECT_EQ(percent_decoded(""), "");
}

// The examples of RFC 4648, section 10.
TEST(UriText, Base64OfEveryLengthIsRead) {
  const std::pair<const char*, const char*> examples[] = {{"Zg==", "f"},         {"Zm8=", "fo"},
                                                          {"Zm9v", "foo"},       {"Zm9vYg==", "foob"},
                                                          {"Zm9vYmE=", "fooba"}, {"Zm9vYmFy", "foobar"}};
  for (const auto& [code, text] : examples) {
    EXPECT_EQ(text_of(data_of_uri(std::string("data:application/octet-stream;base64,") + code)), text);
    EXPECT_EQ(text_of(data_of_uri(std::string("data:image/webp;charset=x;base64,") + code)), text);
  }
  EXPECT_EQ(text_of(data_of_uri("data:;base64,Zm9vYg%3D%3D")), "foob");
  EXPECT_EQ(data_of_uri("data:;base64,+/8=").bytes, (std::vector<unsigned char>{0xfb, 0xff}));
}

TEST(UriText, DataWithoutBase64AreEscapedText) {
  EXPECT_EQ(text_of(data_of_uri("data:text/plain,a+b%20c")), "a+b c");
  EXPECT_EQ(text_of(data_of_uri("data:,%00")), std::string(1, '\0'));
}

TEST(UriText, DataThatCannotBeReadSayWhy) {
  EXPECT_STREQ(data_of_uri("data:;base64,AA*A").problem, "holds a character that is none of base64");
  EXPECT_STREQ(data_of_uri("data:;base64,").problem, "holds no data");
  EXPECT_STREQ(data_of_uri("data:AAAA").problem, "has no comma before its data");
  EXPECT_TRUE(is_data_uri("data:,x"));
  EXPECT_FALSE(is_data_uri("database.bin"));
}

}  // namespace
}  // namespace herr::test
