// Writing a file failed: disk full, quota, no permission, a fault of the disk. Thrown by everything that
// writes; the program exits with 75, or with 2 where the user may not write.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace herr {

// what() is one line, "FILE: cannot STEP: reason; remedy".
class WriteError : public std::runtime_error {
 public:
  WriteError(const std::filesystem::path& file, const std::string& step, int error_number);
  int error_number() const { return error_number_; }

 private:
  int error_number_;
};

}  // namespace herr
