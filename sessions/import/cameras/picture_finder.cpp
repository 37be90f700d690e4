#include "sessions/import/cameras/picture_finder.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

std::string_view without_zeros(std::string_view digits) {
  const std::size_t first = digits.find_first_not_of('0');
  return first == std::string_view::npos ? digits.substr(digits.size() - 1) : digits.substr(first);
}

bool is_whole_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// The runs of digits of a name, without leading zeros.
std::vector<std::string> numbers_in(std::string_view name) {
  std::vector<std::string> numbers;
  std::size_t at = 0;
  while ((at = name.find_first_of("0123456789", at)) != std::string_view::npos) {
    const std::size_t end = std::min(name.find_first_not_of("0123456789", at), name.size());
    numbers.emplace_back(without_zeros(name.substr(at, end - at)));
    at = end;
  }
  return numbers;
}

// Which number of the names tells them apart.
std::size_t telling_number(const std::vector<std::vector<std::string>>& numbers) {
  std::size_t best = 0, most = 0;
  for (std::size_t place = 0; place < numbers.front().size(); ++place) {
    std::set<std::string> values;
    for (const auto& of_name : numbers)
      if (place < of_name.size()) values.insert(of_name[place]);
    if (values.size() >= most) {
      most = values.size();
      best = place;
    }
  }
  return best;
}

}  // namespace

PictureFinder::PictureFinder(const CameraPictures& pictures, std::filesystem::path table)
    : table_(std::move(table)) {
  std::vector<std::vector<std::string>> numbers;
  for (const auto& file : pictures.files) {
    by_name_.emplace(file.filename().string(), names_.size());
    by_stem_.emplace(file.stem().string(), names_.size());
    numbers.push_back(numbers_in(file.stem().string()));
    names_.push_back(file.filename().string());
  }
  const std::size_t telling = telling_number(numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (telling >= numbers[i].size()) continue;
    if (!by_number_.emplace(numbers[i][telling], i).second) twice_.emplace(numbers[i][telling], i);
  }
}

std::optional<std::size_t> PictureFinder::find(std::string_view field, std::int64_t line) const {
  const std::string_view name = field.substr(field.find_last_of("/\\") + 1);
  if (const auto found = by_name_.find(name); found != by_name_.end()) return found->second;
  if (const auto found = by_stem_.find(name); found != by_stem_.end()) return found->second;
  // The table may name pictures of another format, from which these were made.
  if (const std::size_t dot = name.find_last_of('.'); dot != std::string_view::npos && dot > 0)
    if (const auto found = by_stem_.find(name.substr(0, dot)); found != by_stem_.end()) return found->second;
  if (!is_whole_number(name)) return std::nullopt;
  const std::string_view number = without_zeros(name);
  if (const auto second = twice_.find(number); second != twice_.end())
    throw InputError(table_, line,
                     "names picture " + std::string(number) + ", and both '" +
                         printable(names_[by_number_.find(number)->second]) + "' and '" +
                         printable(names_[second->second]) + "' hold that number",
                     "give each camera a folder of its own, or name the files in the table");
  const auto found = by_number_.find(number);
  return found == by_number_.end() ? std::nullopt : std::optional<std::size_t>(found->second);
}

}  // namespace herr
