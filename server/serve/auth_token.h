// The secret that clients must show, from a file that nobody else may read. It never stands on a command line
// or in a message. Before: --auth-token-file. After: http_server compares.
#pragma once

#include <filesystem>
#include <string>

namespace herr {

inline constexpr std::size_t kShortestToken = 16, kLongestToken = 1024;

// One line of letters, digits and - . _ ~ + / =, as RFC 6750 has it. Throws UsageError: no regular file, mode
// beyond 0600, another form.
std::string read_auth_token(const std::filesystem::path& file);

}  // namespace herr
