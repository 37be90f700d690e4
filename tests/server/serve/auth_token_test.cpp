// The file with the token: what is taken, what is refused, and that no message shows a piece of it.
#include "server/serve/auth_token.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "server/process/exit_code.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

class AuthToken : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& text, mode_t mode = 0600) const {
    const std::filesystem::path path = folder_.path() / "token";
    std::filesystem::remove(path);
    std::ofstream(path) << text;
    ::chmod(path.c_str(), mode);
    return path;
  }
  // The one line of the refusal; empty when it was taken.
  std::string refusal(const std::filesystem::path& path) const {
    try {
      read_auth_token(path);
      return {};
    } catch (const UsageError& error) {
      return error.what();
    }
  }
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

TEST_F(AuthToken, IsTheOneLineOfItsFile) {
  const std::string token = "AZaz09-._~+/=AZaz";
  EXPECT_EQ(read_auth_token(file(token)), token);
  EXPECT_EQ(read_auth_token(file(token + "\n")), token);
  EXPECT_EQ(read_auth_token(file(token + "\r\n", 0400)), token);
  EXPECT_EQ(read_auth_token(file(std::string(1024, 'x') + "\r\n")).size(), 1024u);
}

TEST_F(AuthToken, AFileThatOthersMayReadIsRefused) {
  for (const mode_t mode : {0640u, 0604u, 0660u, 0644u, 0610u})
    EXPECT_NE(refusal(file("0123456789abcdef", mode)).find("chmod 600"), std::string::npos) << mode;
  EXPECT_NE(refusal(file("0123456789abcdef", 0644)).find("has mode 0644"), std::string::npos);
}

TEST_F(AuthToken, OtherFormsAreRefusedWithoutBeingShown) {
  for (const std::string& text :
       {std::string(), std::string("\n"), std::string("shortsecret"), std::string("0123456789abcde"),
        std::string("two words of some length"), std::string("0123456789abcdef\n0123456789abcdef"),
        std::string("0123456789abcdef\0", 17), std::string("0123456789abcdef\xC3\xA4"),
        std::string(1025, 'x'), std::string(100000, 'x')}) {
    const std::string message = refusal(file(text));
    EXPECT_NE(message.find("is not one line of 16 to 1024"), std::string::npos) << text.substr(0, 20);
    if (text.size() > 4) {
      EXPECT_EQ(message.find(text.substr(0, 5)), std::string::npos) << message;
    }
  }
}

TEST_F(AuthToken, WhatIsNoFileIsRefused) {
  EXPECT_NE(refusal(folder() / "nowhere").find("No such file"), std::string::npos);
  EXPECT_NE(refusal(folder()).find("is no regular file"), std::string::npos);
  ASSERT_EQ(::mkfifo((folder() / "pipe").c_str(), 0600), 0);
  EXPECT_NE(refusal(folder() / "pipe").find("is no regular file"), std::string::npos);
}

}  // namespace
}  // namespace herr
