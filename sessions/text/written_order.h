// Quaternions that look as if they were written w, x, y, z, as many programs write them. Before: four numbers
// of a document, an event, a view file. After: a warning.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace herr {

struct OrderDoubt {
  std::string problem;  // "is [1, 0, 0, 0], which looks w-first"
  std::string remedy;   // "here w is last: write [0, 0, 0, 1], or where half a turn is meant [-1, 0, 0, 0]"
};

// Here w is last. A quaternion looks w-first when its first number is at least 0.7 and its last is 0:
// w-first, that is a turn of at most 90 degrees about x, y or a line between, as files are full of; w-last it
// is half a turn about a line near x, which few mean. [-1, 0, 0, 0] is the same half turn about x, and no
// program writes w as -1 alone: it does not look so.
std::optional<OrderDoubt> order_doubt(const std::array<double, 4>& xyzw);

}  // namespace herr
