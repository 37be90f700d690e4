// Two things that were measured differ in more than the program: no verdict can be given. Each by itself may
// be sound. Before: whoever compares throws. After: the verdict "not comparable", exit code 4.
#pragma once

#include <stdexcept>

namespace herr {

// what() is one line that says which thing differs and how.
class NotComparable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace herr
