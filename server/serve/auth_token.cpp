#include "server/serve/auth_token.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "server/process/exit_code.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"

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

std::string mode_text(unsigned bits) {
  return {'0', static_cast<char>('0' + (bits >> 6)), static_cast<char>('0' + (bits >> 3 & 7u)),
          static_cast<char>('0' + (bits & 7u))};
}

InputFile open_token_file(const std::filesystem::path& file) {
  OpenedFile opened = open_for_reading(file);
  if (opened.error != 0)
    refuse(file, "cannot be read: " + std::generic_category().message(opened.error), "check the path");
  try {
    return {file, std::move(opened)};
  } catch (const InputError&) {
    refuse(file, "is no regular file", "write the token into one");
  }
}

}  // namespace

std::string read_auth_token(const std::filesystem::path& file) {
  const InputFile opened = open_token_file(file);
  if ((opened.mode() & 077u) != 0)
    refuse(file, "has mode " + mode_text(opened.mode()) + ", so others may read it", "chmod 600");

  std::string token(kLongestToken + 3, '\0');
  token.resize(opened.read_at(0, token.data(), token.size()));
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
