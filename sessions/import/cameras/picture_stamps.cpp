#include "sessions/import/cameras/picture_stamps.h"

#include <algorithm>
#include <string_view>

#include "sessions/files/input_error.h"
#include "sessions/import/cameras/exif_time.h"
#include "sessions/import/cameras/name_pattern.h"
#include "sessions/import/cameras/picture_order.h"
#include "sessions/import/text/date_text.h"

namespace herr {
namespace {

// A stamp without sub-seconds, as far as its text tells.
bool has_no_fraction(const NamePattern& pattern, const NamePattern::Found& found) {
  return pattern.in_seconds() && found.stamp_ns % 1'000'000'000 == 0;
}

// A number in a name that can be time since 1970 by its number of digits.
struct EpochNumber {
  std::size_t begin = 0, end = 0;
  const char* unit = "";
};

std::vector<EpochNumber> epoch_numbers(std::string_view stem) {
  const auto is_digit = [&](std::size_t i) { return i < stem.size() && stem[i] >= '0' && stem[i] <= '9'; };
  std::vector<EpochNumber> numbers;
  for (std::size_t i = 0; i < stem.size(); ++i) {
    if (!is_digit(i)) continue;
    std::size_t end = i;
    while (is_digit(end)) ++end;
    const std::size_t digits = end - i;
    if (digits == 13) numbers.push_back({i, end, "{ms}"});
    if (digits == 16) numbers.push_back({i, end, "{us}"});
    if (digits == 19) numbers.push_back({i, end, "{ns}"});
    if (digits == 10 && end < stem.size() && stem[end] == '.' && is_digit(end + 1)) {
      ++end;
      while (is_digit(end)) ++end;
      numbers.push_back({i, end, "{s}"});
    }
    i = end;
  }
  return numbers;
}

// `text` with {*} for each run of digits, of a counter for instance.
std::string with_any_numbers(std::string_view text) {
  std::string pattern;
  bool digits = false;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit) pattern += c;
    if (digit && !digits) pattern += "{*}";
    digits = digit;
  }
  return pattern;
}

bool has_few_wildcards(std::string_view pattern) {
  std::size_t count = 0;
  for (const char c : pattern) count += c == '*';
  return count <= 2;
}

// Every name fits, and their stamps grow.
bool fits_all(const CameraPictures& pictures, const std::string& text) {
  const NamePattern pattern(text, folder_of(pictures));
  std::optional<TimeNs> before;
  for (const auto& file : pictures.files) {
    const std::string stem = file.stem().string();
    const auto found = pattern.find(stem, {});
    if (!found || (before && found->stamp_ns <= *before)) return false;
    before = found->stamp_ns;
  }
  return true;
}

TimeNs exif_stamp(const std::filesystem::path& file, const ExifTime& time, std::optional<int> zone_minutes) {
  if (const auto own = parse_zone(time.offset)) zone_minutes = own;
  if (!zone_minutes)
    throw InputError(file, 0, "has an EXIF time without a zone ('" + printable(time.date) + "')",
                     "give --camera-zone, as +01:00: the zone that the camera's clock was set to");
  const auto stamp = parse_date(time.date + "." + (time.sub_seconds.empty() ? "0" : time.sub_seconds),
                                "%Y:%m:%d %H:%M:%S.%f", zone_minutes);
  if (!stamp)
    throw InputError(file, 0, "has an EXIF time that is none ('" + printable(time.date) + "')",
                     "write YYYY:MM:DD HH:MM:SS, or give the stamps another way");
  return *stamp;
}

}  // namespace

StampedPictures stamps_from_names(const CameraPictures& pictures, const std::string& pattern_text,
                                  std::optional<int> zone_minutes) {
  const NamePattern pattern(pattern_text, folder_of(pictures));
  StampedPictures stamped;
  stamped.source = "the names of the files";
  std::vector<bool> seconds_only;
  bool zone_assumed = false;
  for (const auto& file : pictures.files) {
    const std::string stem = file.stem().string();
    const auto found = pattern.find(stem, zone_minutes);
    if (!found) continue;
    stamped.pictures.push_back({found->stamp_ns, file});
    seconds_only.push_back(has_no_fraction(pattern, *found));
    zone_assumed |=
        pattern.is_date() && !zone_minutes && !date_names_zone(found->text, pattern.date_format());
  }
  // A name that happens to fall on a whole second among others that do not is no fault.
  if (std::find(seconds_only.begin(), seconds_only.end(), false) == seconds_only.end())
    refuse_whole_seconds(stamped, seconds_only, "the name");
  put_in_order(stamped, pictures, "do not fit the pattern '" + printable(pattern_text) + "' of names");
  if (zone_assumed)
    stamped.assumed.emplace_back("the dates in the names of the pictures name no zone and are taken as UTC");
  return stamped;
}

StampedPictures stamps_from_exif(const CameraPictures& pictures, std::optional<int> zone_minutes) {
  StampedPictures stamped;
  stamped.source = "EXIF";
  std::vector<bool> seconds_only;
  for (const auto& file : pictures.files) {
    const std::optional<ExifTime> time = read_exif_time(file);
    if (!time) continue;
    stamped.pictures.push_back({exif_stamp(file, *time, zone_minutes), file});
    seconds_only.push_back(time->sub_seconds.empty());
  }
  refuse_whole_seconds(stamped, seconds_only, "the EXIF time");
  put_in_order(stamped, pictures, "have no EXIF time of recording (DateTimeOriginal)");
  const auto whole = std::count(seconds_only.begin(), seconds_only.end(), true);
  if (whole > 0)
    stamped.remarks.push_back(
        std::to_string(whole) + " of " + std::to_string(pictures.files.size()) +
        " pictures have whole seconds only in EXIF: their stamps are up to a second early");
  return stamped;
}

std::optional<std::string> stamp_pattern_of(const CameraPictures& pictures) {
  const std::string first = pictures.files.front().stem().string();
  if (first.find_first_of("{}*") != std::string::npos) return std::nullopt;
  for (const EpochNumber& number : epoch_numbers(first)) {
    const std::string before = first.substr(0, number.begin), after = first.substr(number.end);
    for (const std::string& pattern :
         {before + number.unit + after, with_any_numbers(before) + number.unit + with_any_numbers(after)})
      if (pattern.size() <= 255 && has_few_wildcards(pattern) && fits_all(pictures, pattern)) return pattern;
  }
  return std::nullopt;
}

}  // namespace herr
