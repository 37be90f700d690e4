// The user's input is wrong: which file, where in it, what is wrong and what to do about it.
// Thrown by everything that reads a file; only the program's main() turns it into an exit code.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace herr {

// what() is one line, "FILE:LINE: problem; remedy" (no ":LINE" when line is 0), control characters escaped.
class InputError : public std::runtime_error {
 public:
  InputError(const std::filesystem::path& file, std::int64_t line, const std::string& problem,
             const std::string& remedy);
};

// `text` with control characters and bytes that are not UTF-8 written as \xNN, cut to 200 bytes: safe to
// print.
std::string printable(const std::string& text);

}  // namespace herr
