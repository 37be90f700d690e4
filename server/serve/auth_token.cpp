#include "server/serve/auth_token.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "server/process/exit_code.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& problem,
                         const std::string& remedy) {
  throw UsageError("--auth-token-file: " + printable(file.string()) + " " + problem + "; " + remedy);
}

bool is_token_character(char c) {
  const bool word = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return word || std::string_view("-._~+/=").find(c) != std::string_view::npos;
}

std::string mode_text(mode_t mode) {
  const unsigned bits = mode & 0777u;
  return {'0', static_cast<char>('0' + (bits >> 6)), static_cast<char>('0' + (bits >> 3 & 7u)),
          static_cast<char>('0' + (bits & 7u))};
}

struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

}  // namespace

std::string read_auth_token(const std::filesystem::path& file) {
  // A pipe must not hold us up.
  const Descriptor opened{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (opened.fd < 0) refuse(file, std::string("cannot be read: ") + std::strerror(errno), "check the path");
  struct stat status {};
  if (::fstat(opened.fd, &status) != 0 || !S_ISREG(status.st_mode))
    refuse(file, "is no regular file", "write the token into one");
  if ((status.st_mode & 077u) != 0)
    refuse(file, "has mode " + mode_text(status.st_mode) + ", so others may read it", "chmod 600");

  std::array<char, kLongestToken + 3> buffer{};
  std::string token;
  for (ssize_t count = 0; token.size() < buffer.size() &&
                          (count = ::read(opened.fd, buffer.data(), buffer.size() - token.size())) > 0;)
    token.append(buffer.data(), static_cast<std::size_t>(count));
  while (!token.empty() && (token.back() == '\n' || token.back() == '\r')) token.pop_back();
  // What is wrong is told without a piece of it.
  if (token.size() < kShortestToken || token.size() > kLongestToken ||
      !std::all_of(token.begin(), token.end(), is_token_character))
    refuse(file,
           "is not one line of " + std::to_string(kShortestToken) + " to " + std::to_string(kLongestToken) +
               " letters, digits and -._~+/=",
           "make one with: openssl rand -hex 32");
  return token;
}

}  // namespace herr
