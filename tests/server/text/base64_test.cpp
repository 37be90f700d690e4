// Bytes as text and back: the examples of RFC 4648, all lengths, and texts that are none.
#include "server/text/base64.h"

#include <gtest/gtest.h>

namespace herr {
namespace {

std::vector<std::byte> bytes_of(std::string_view text) {
  std::vector<std::byte> bytes;
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
  return bytes;
}

TEST(Base64, WritesTheExamplesOfItsStandard) {
  EXPECT_EQ(base64_text(bytes_of("")), "");
  EXPECT_EQ(base64_text(bytes_of("f")), "Zg==");
  EXPECT_EQ(base64_text(bytes_of("fo")), "Zm8=");
  EXPECT_EQ(base64_text(bytes_of("foo")), "Zm9v");
  EXPECT_EQ(base64_text(bytes_of("foob")), "Zm9vYg==");
  EXPECT_EQ(base64_text(bytes_of("fooba")), "Zm9vYmE=");
  EXPECT_EQ(base64_text(bytes_of("foobar")), "Zm9vYmFy");
}

TEST(Base64, ReadsBackWhatItWrites) {
  std::vector<std::byte> bytes;
  for (int i = 0; i < 300; ++i) {
    EXPECT_EQ(bytes_from_base64(base64_text(bytes)), bytes) << i;
    bytes.push_back(static_cast<std::byte>(i * 37 + 250));
  }
}

TEST(Base64, RefusesWhatItWouldNotWrite) {
  for (const char* text :
       {"Z", "Zg", "Zg=", "Zg==Zg==", "Zh==", "Zm9=", "Z===", "====", "Zm9v\n", "Zm 9", "=m9v"}) {
    EXPECT_FALSE(bytes_from_base64(text)) << text;
  }
}

}  // namespace
}  // namespace herr
