// The user's input is wrong: which file, where in it, what is wrong and what to do about it.
// Thrown by everything that reads a file; only the program's main() turns it into an exit code.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

namespace herr {

// what() is one line, "FILE:LINE: problem; remedy" (no ":LINE" when line is 0), control characters escaped.
class InputError : public std::runtime_error {
 public:
  InputError(const std::filesystem::path& file, std::int64_t line, const std::string& problem,
             const std::string& remedy);

  // The parts of what(), escaped as there; line() is 0 where the whole file is meant.
  const std::string& file() const { return parts_->file; }
  std::int64_t line() const { return parts_->line; }
  const std::string& problem() const { return parts_->problem; }
  const std::string& remedy() const { return parts_->remedy; }

 private:
  struct Parts {
    std::string file, problem, remedy;
    std::int64_t line = 0;
  };
  explicit InputError(std::shared_ptr<const Parts> parts);
  static std::string message(const Parts& parts);

  std::shared_ptr<const Parts> parts_;  // shared: copying an exception must not throw
};

// `text` with control characters and bytes that are not UTF-8 written as \xNN, cut to
// 200 bytes: safe to print.
std::string printable(const std::string& text);

}  // namespace herr
