// What is wrong or remarkable about a recording: one entry for each kind, however often it occurs, so that a
// list of a million bad rows stays a page. Bounded memory.
// Before: the meters of this folder. After: the report of `herr inspect`.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"

namespace herr {

enum class Severity {
  error,    // replay refuses the recording for it
  warning,  // replay shows something that the headset's user did not see
  note      // worth knowing
};
const char* name_of(Severity severity);

struct Finding {
  Severity severity = Severity::note;
  InputError first;                   // the first of its kind, or the worst where they can be compared
  bool skippable = false;             // an error that replay leaves out with --keep-going
  std::int64_t count = 1;             // of this kind
  std::int64_t last_line = 0;         // of the last one, 0 where the first has no line
  std::vector<std::string> others{};  // the worst of the rest, "48.2 ms at line 203"; may be empty

  // "FILE:LINE: problem; remedy".
  std::string text() const { return first.what(); }
  // "and 37 more, the last at line 900"; empty when there is one.
  std::string rest() const;
};

class FindingList {
 public:
  // Counted with an earlier one when they differ only in numbers and quoted names.
  void add(Severity severity, const InputError& error, bool skippable = false);
  // An entry of its own.
  void add(Finding finding);

  // Errors first, each severity in the order in which it was met.
  std::vector<Finding> sorted() const;
  std::int64_t kinds(Severity severity) const;  // entries
  std::int64_t count(Severity severity) const;  // all occurrences
  std::int64_t skippable_errors() const;        // all occurrences
  // The one that replay would stop at, or none.
  const Finding* first_error() const;

 private:
  std::vector<Finding> findings_;
  std::map<std::string, std::size_t> place_of_kind_;
};

}  // namespace herr
