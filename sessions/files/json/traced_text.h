// Where the JSON parser has come to. Before: a text. After: strict_json, json_line.
#pragma once

#include <cstddef>
#include <iterator>

namespace herr {

// Reads characters and leaves word of how far the parser has come: the parser itself tells its handler
// nothing about places, and an error without a line is hard to act on.
class TracedText {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  TracedText(const char* at, const char** reached) : at_(at), reached_(reached) {}
  reference operator*() const { return *at_; }
  TracedText& operator++() {
    *reached_ = ++at_;
    return *this;
  }
  TracedText operator++(int) {
    TracedText before = *this;
    ++*this;
    return before;
  }
  bool operator==(const TracedText& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  const char** reached_;
};

}  // namespace herr
