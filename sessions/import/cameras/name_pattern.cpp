#include "sessions/import/cameras/name_pattern.h"

#include <algorithm>

#include "sessions/files/input_error.h"
#include "sessions/import/text/date_text.h"
#include "sessions/text/letters.h"

namespace herr {
namespace {

constexpr int kMostWildcards = 2;  // each tries every place of a name
constexpr std::size_t kLongestPattern = 255;
constexpr std::size_t kLongestDate = 64;
constexpr const char* kPatternRemedy = "write as {ms}, frame_{ns}, {*}_{s} or img_{date:%Y%m%d_%H%M%S%f}";

}  // namespace

NamePattern::NamePattern(const std::string& pattern, const std::filesystem::path& folder)
    : pattern_(pattern) {
  if (pattern.size() > kLongestPattern) fail(folder, "is longer than 255 bytes", kPatternRemedy);
  std::string_view rest = pattern_;
  while (!rest.empty()) {
    const std::size_t brace = rest.find('{');
    if (brace > 0) pieces_.push_back({Kind::literal, std::string(rest.substr(0, brace))});
    if (brace == std::string_view::npos) break;
    const std::size_t end = rest.find('}', brace);
    if (end == std::string_view::npos) fail(folder, "has an open brace", kPatternRemedy);
    add_brace(std::string(rest.substr(brace + 1, end - brace - 1)), folder);
    rest.remove_prefix(end + 1);
  }
  if (!stamp_) fail(folder, "has no {s}, {ms}, {us}, {ns} or {date}", kPatternRemedy);
}

void NamePattern::fail(const std::filesystem::path& folder, const std::string& problem,
                       const std::string& remedy) const {
  throw InputError(folder, 0, "the pattern '" + printable(pattern_) + "' of the pictures' names " + problem,
                   remedy);
}

void NamePattern::add_brace(const std::string& word, const std::filesystem::path& folder) {
  if (word == "*") {
    if (++wildcards_ > kMostWildcards) fail(folder, "has more than two {*}", kPatternRemedy);
    pieces_.push_back({Kind::any, {}});
    return;
  }
  if (word == "date" || word.starts_with("date:")) {
    date_ = true;
    date_format_ = word.size() > 5 ? word.substr(5) : std::string();
    if (const auto fault = date_format_fault(date_format_)) fail(folder, fault->problem, fault->remedy);
  } else if (word == "s" || word == "ms" || word == "us" || word == "ns") {
    unit_ = *time_unit(word);
  } else {
    fail(folder, "has an unknown {" + printable(word) + "}", kPatternRemedy);
  }
  if (stamp_) fail(folder, "has two stamps", kPatternRemedy);
  stamp_ = true;
  pieces_.push_back({Kind::stamp, {}});
}

bool NamePattern::in_seconds() const {
  return date_ || unit_ == TimeUnit::s;
}

std::optional<NamePattern::Found> NamePattern::find(std::string_view stem,
                                                    std::optional<int> zone_minutes) const {
  Found found;
  if (!fits(0, stem, zone_minutes, found)) return std::nullopt;
  return found;
}

bool NamePattern::fits(std::size_t piece, std::string_view rest, std::optional<int> zone_minutes,
                       Found& found) const {
  if (piece == pieces_.size()) return rest.empty();
  const Piece& now = pieces_[piece];
  if (now.kind == Kind::literal)
    return rest.starts_with(now.text) && fits(piece + 1, rest.substr(now.text.size()), zone_minutes, found);
  if (now.kind == Kind::stamp) return fits_stamp(piece, rest, zone_minutes, found);
  for (std::size_t length = 0; length <= rest.size(); ++length)
    if (fits(piece + 1, rest.substr(length), zone_minutes, found)) return true;
  return false;
}

// The longest text first: "{ms}{*}" takes all digits.
bool NamePattern::fits_stamp(std::size_t piece, std::string_view rest, std::optional<int> zone_minutes,
                             Found& found) const {
  const auto from = [&](std::size_t at) {
    return static_cast<std::size_t>(
        std::find_if_not(rest.begin() + static_cast<std::ptrdiff_t>(at), rest.end(), is_digit) -
        rest.begin());
  };
  std::size_t longest = std::min(rest.size(), kLongestDate);
  if (!date_) {
    longest = from(0);
    if (longest > 0 && longest < rest.size() && (rest[longest] == '.' || rest[longest] == ',')) {
      const std::size_t end = from(longest + 1);
      if (end > longest + 1) longest = end;
    }
  }
  for (std::size_t length = longest; length > 0; --length) {
    const std::string_view text = rest.substr(0, length);
    if (!date_ && !is_digit(text.back())) continue;
    const char decimal = text.find(',') == std::string_view::npos ? '.' : ',';
    const auto stamp =
        date_ ? parse_date(text, date_format_, zone_minutes) : parse_stamp(text, unit_, decimal);
    if (!stamp || !fits(piece + 1, rest.substr(length), zone_minutes, found)) continue;
    found = {text, *stamp};
    return true;
  }
  return false;
}

}  // namespace herr
