// Patterns of file names that hold a stamp: "frame_{ms}". Before: `--camera-names`, a map's layouts.
// After: picture_stamps.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sessions/format/pose.h"
#include "sessions/import/text/stamp_text.h"

namespace herr {

class NamePattern {
 public:
  // Throws InputError about `folder` that quotes the pattern: no stamp or two, an unknown or open brace, a
  // format of dates that is none, more than two {*}.
  NamePattern(const std::string& pattern, const std::filesystem::path& folder);

  struct Found {
    std::string_view text;  // of the stamp, within the name
    TimeNs stamp_ns = 0;
  };
  // Of a name without its extension; none where it does not fit as a whole.
  std::optional<Found> find(std::string_view stem, std::optional<int> zone_minutes) const;

  bool is_date() const { return date_; }
  const std::string& date_format() const { return date_format_; }
  // Whether stamps without a fraction are whole seconds.
  bool in_seconds() const;

 private:
  enum class Kind { literal, any, stamp };
  struct Piece {
    Kind kind = Kind::literal;
    std::string text;
  };
  void add_brace(const std::string& word, const std::filesystem::path& folder);
  [[noreturn]] void fail(const std::filesystem::path& folder, const std::string& problem,
                         const std::string& remedy) const;
  bool fits(std::size_t piece, std::string_view rest, std::optional<int> zone_minutes, Found& found) const;
  bool fits_stamp(std::size_t piece, std::string_view rest, std::optional<int> zone_minutes,
                  Found& found) const;

  std::string pattern_;
  std::vector<Piece> pieces_;
  bool date_ = false, stamp_ = false;
  TimeUnit unit_ = TimeUnit::s;
  std::string date_format_;
  int wildcards_ = 0;
};

}  // namespace herr
