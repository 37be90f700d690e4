// Which known name a mistyped or foreign one stands for: keys of documents, flags, words, columns.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace herr {

// The shortest known name that `unknown` begins (three letters or more), else the nearest by edit distance,
// where two letters that changed places count once. Empty where none is near, that is where more than a third
// of the letters differ: a wrong guess leads astray. Dashes in front are not counted.
std::string nearest_name(std::string_view unknown, const std::vector<std::string>& known);

// A key that another program calls so: which known one it is, and what that holds (may be empty).
struct KeySynonym {
  const char* foreign;
  const char* known;
  const char* holds;
};
// The first of the list whose foreign name is `unknown` and whose own name is among the known; null: none.
const KeySynonym* key_synonym(std::string_view unknown, const std::vector<std::string>& known);

// What to do about an unknown key: "did you mean 'base_colour'?", or the list of those that are known.
std::string key_remedy(std::string_view unknown, const std::vector<std::string>& known);

}  // namespace herr
