#include "server/check/allowed_differences.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "server/check/measure/not_comparable.h"
#include "sessions/files/input_error.h"
#include "sessions/text/plain_values.h"

namespace herr {
namespace {

// What people may ask for in vain.
constexpr std::array<std::string_view, 8> kOfTheMachine{"isa", "--isa",   "machine", "cpu",
                                                        "CPU", "threads", "build",   "libraries"};
constexpr std::array<std::string_view, 6> kSessionFiles{"session.json",  "events.jsonl",  "pose/data.csv",
                                                        "gaze/data.csv", "cam0/data.csv", "cam1/data.csv"};
constexpr std::array<std::string_view, 2> kSessionPictures{"cam0/data", "cam1/data"};
// Inputs that a setting names, or a session in its place.
constexpr std::array<std::string_view, 2> kOfSettings{"the display profile", "the view"};
constexpr std::string_view kSpan = "--start, --duration, --frames";

template <std::size_t N>
bool is_one_of(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Parts that each make a difference allowed, by themselves.
std::vector<DifferentPart> parts_of(const FingerprintDifference& difference) {
  const std::string_view name = difference.name;
  if (difference.of_input) {
    if (is_one_of(kSessionFiles, name) || is_one_of(kSessionPictures, name)) return {DifferentPart::session};
    // A session may name the profile.
    if (name == kOfSettings[0]) return {DifferentPart::settings, DifferentPart::session};
    if (is_one_of(kOfSettings, name)) return {DifferentPart::settings};
    return {DifferentPart::scene};
  }
  if (name == "--isa") return {DifferentPart::never};
  if (name == "--scene") return {DifferentPart::scene};
  if (name == kSpan) return {DifferentPart::settings, DifferentPart::session};
  return {DifferentPart::settings};
}

void add_once(std::vector<DifferentPart>& parts, DifferentPart part) {
  if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
}

std::string list_of(const std::vector<DifferentPart>& parts) {
  std::string text;
  for (const DifferentPart part : kAllowableParts) {
    if (std::find(parts.begin(), parts.end(), part) == parts.end()) continue;
    text += (text.empty() ? "" : ",") + std::string(name_of(part));
  }
  return text;
}

}  // namespace

const char* name_of(DifferentPart part) {
  switch (part) {
    case DifferentPart::scene:
      return "scene";
    case DifferentPart::settings:
      return "settings";
    case DifferentPart::session:
      return "session";
    case DifferentPart::never:
      return "instruction set";
  }
  return "unknown";
}

void AllowedDifferences::add(DifferentPart part) {
  add_once(parts_, part);
}

bool AllowedDifferences::has(DifferentPart part) const {
  return std::find(parts_.begin(), parts_.end(), part) != parts_.end();
}

AllowedDifferences allowed_differences_from(const std::string& text) {
  std::vector<std::string> words;
  for (const DifferentPart part : kAllowableParts) words.emplace_back(name_of(part));
  AllowedDifferences allowed;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (is_one_of(kOfTheMachine, word)) {
      throw std::invalid_argument("'" + printable(word) +
                                  "' may never differ, times of two machines do not compare; choose from "
                                  "scene, settings and session");
    }
    const DifferentPart part = kAllowableParts[word_from(word, words)];
    if (allowed.has(part)) {
      throw std::invalid_argument("'" + word + "' is named twice; name it once");
    }
    allowed.add(part);
    at = end + 1;
  }
  return allowed;
}

std::vector<AllowedDifference> told_differences(const std::vector<FingerprintDifference>& found,
                                                const AllowedDifferences& allowed, const std::string& what) {
  std::vector<std::pair<DifferentPart, std::string>> told;
  std::vector<DifferentPart> needed;
  std::string first;
  for (const FingerprintDifference& difference : found) {
    const std::vector<DifferentPart> parts = parts_of(difference);
    if (parts.front() == DifferentPart::never) throw NotComparable(what + ": " + difference.text);
    const auto part =
        std::find_if(parts.begin(), parts.end(), [&](DifferentPart each) { return allowed.has(each); });
    // All that it needs, not only what is not allowed yet: the flag is given once.
    add_once(needed, part == parts.end() ? parts.front() : *part);
    if (part != parts.end()) {
      told.emplace_back(*part, difference.text);
    } else if (first.empty()) {
      first = difference.text;
    }
  }
  if (!first.empty()) {
    throw NotComparable(what + ": " + first + "; --allow-different " + list_of(needed) +
                        " compares all the same");
  }
  const auto by_part = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(told.begin(), told.end(), by_part);
  std::vector<AllowedDifference> lines;
  for (const auto& [part, text] : told) lines.push_back({name_of(part), text});
  return lines;
}

}  // namespace herr
