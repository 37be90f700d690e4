#include "sessions/inspect/findings.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace herr {
namespace {

constexpr std::size_t kMostKinds = 200;  // more than one can read, and a bound on memory

// The text with numbers and what stands in quotes replaced.
std::string shape_of(std::string_view text) {
  std::string shape;
  while (!text.empty()) {
    const std::size_t number = text.find_first_not_of("0123456789.");
    const std::size_t closing = text.front() == '\'' ? text.find('\'', 1) : std::string_view::npos;
    if (closing != std::string_view::npos) {
      shape += "''";
      text.remove_prefix(closing + 1);
    } else if (number != 0) {
      shape += '#';
      text.remove_prefix(std::min(number, text.size()));
    } else {
      shape += text.front();
      text.remove_prefix(1);
    }
  }
  return shape;
}

}  // namespace

const char* name_of(Severity severity) {
  switch (severity) {
    case Severity::error:
      return "error";
    case Severity::warning:
      return "warning";
    case Severity::note:
      return "note";
  }
  return "unknown";
}

std::string Finding::rest() const {
  if (count <= 1) return "";
  std::string text = "and " + std::to_string(count - 1) + " more";
  if (others.empty()) return last_line > 0 ? text + ", the last at line " + std::to_string(last_line) : text;
  for (std::size_t i = 0; i < others.size(); ++i) text += (i == 0 ? ": " : ", ") + others[i];
  return static_cast<std::int64_t>(others.size()) < count - 1 ? text + ", ..." : text;
}

void FindingList::add(Severity severity, const InputError& error, bool skippable) {
  std::string kind = std::string(name_of(severity)) + error.file() + "\n" + shape_of(error.problem());
  // Beyond the bound all that differ otherwise are counted as one.
  if (place_of_kind_.size() >= kMostKinds && !place_of_kind_.contains(kind)) kind = name_of(severity);
  const auto [entry, added] = place_of_kind_.try_emplace(std::move(kind), findings_.size());
  if (added) {
    findings_.push_back({severity, error, skippable, 1, error.line()});
    return;
  }
  Finding& finding = findings_[entry->second];
  ++finding.count;
  finding.last_line = error.line();
  finding.skippable = finding.skippable && skippable;
}

void FindingList::add(Finding finding) {
  findings_.push_back(std::move(finding));
}

std::vector<Finding> FindingList::sorted() const {
  std::vector<Finding> sorted = findings_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Finding& a, const Finding& b) { return a.severity < b.severity; });
  return sorted;
}

std::int64_t FindingList::kinds(Severity severity) const {
  return std::count_if(findings_.begin(), findings_.end(),
                       [=](const Finding& finding) { return finding.severity == severity; });
}

std::int64_t FindingList::count(Severity severity) const {
  std::int64_t count = 0;
  for (const Finding& finding : findings_)
    if (finding.severity == severity) count += finding.count;
  return count;
}

std::int64_t FindingList::skippable_errors() const {
  std::int64_t count = 0;
  for (const Finding& finding : findings_)
    if (finding.severity == Severity::error && finding.skippable) count += finding.count;
  return count;
}

const Finding* FindingList::first_error() const {
  const auto found = std::find_if(findings_.begin(), findings_.end(),
                                  [](const Finding& f) { return f.severity == Severity::error; });
  return found == findings_.end() ? nullptr : &*found;
}

}  // namespace herr
