#include "sessions/files/json/json_line.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "sessions/files/json/traced_text.h"

namespace herr {
namespace {

using nlohmann::json;

constexpr std::size_t kMostLevels = 64;

// Follows the text to the innermost place on the way to `field`.
class PlaceFinder : public nlohmann::json_sax<json> {
 public:
  PlaceFinder(const char* const& reached, const std::string& field) : reached_(reached), field_(field) {}

  const char* found() const { return found_; }

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(-1); }
  bool start_array(std::size_t) override { return open(0); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    path_.resize(levels_.back().path_length);
    if (!path_.empty()) path_ += '.';
    path_ += name;
    take_note();
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  struct Level {
    std::size_t path_length = 0;
    std::int64_t index = -1;  // of the next element; -1: an object
  };

  void take_note() {
    const bool leads_there =
        field_.starts_with(path_) && (path_.size() == field_.size() || field_[path_.size()] == '.' ||
                                      field_[path_.size()] == '[' || path_.empty());
    if (!leads_there || (found_ != nullptr && path_.size() <= found_length_)) return;
    found_ = reached_ - 1;
    found_length_ = path_.size();
  }
  // Elements of arrays are noted where they begin, members of objects at their keys.
  bool value() {
    if (levels_.empty()) {
      take_note();
    } else if (levels_.back().index >= 0) {
      path_.resize(levels_.back().path_length);
      path_ += '[' + std::to_string(levels_.back().index++) + ']';
      take_note();
    }
    return true;
  }
  bool open(std::int64_t first) {
    value();
    levels_.push_back({path_.size(), first});
    return levels_.size() <= kMostLevels;
  }
  bool close() {
    path_.resize(levels_.back().path_length);
    levels_.pop_back();
    return true;
  }

  const char* const& reached_;
  const std::string& field_;
  std::string path_;  // of the value that comes
  std::vector<Level> levels_;
  const char* found_ = nullptr;
  std::size_t found_length_ = 0;
};

}  // namespace

std::int64_t json_line(std::string_view text, const std::string& field) {
  const char* reached = text.data();
  const TracedText first(text.data(), &reached), last(text.data() + text.size(), &reached);
  PlaceFinder finder(reached, field);
  if (!json::sax_parse(first, last, &finder) || finder.found() == nullptr) return 0;
  return 1 + std::count(text.data(), std::max(text.data(), finder.found()), '\n');
}

}  // namespace herr
