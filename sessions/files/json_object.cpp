// JsonObject and JsonDocument of strict_json.h: typed, bounded reads of the fields of one object.
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/files/json/json_line.h"
#include "sessions/files/nearest_name.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

using nlohmann::json;

std::string range(double lowest, double highest) {
  return "from " + shown_number(lowest) + " to " + shown_number(highest);
}

const char* described(const json& value) {
  switch (value.type()) {
    case json::value_t::null:
      return "null";
    case json::value_t::boolean:
      return "a truth value";
    case json::value_t::string:
      return "a text";
    case json::value_t::array:
      return "an array";
    case json::value_t::object:
      return "an object";
    default:
      return "a number";
  }
}

double checked_number(const JsonObject& owner, const char* key, const json& value, double lowest,
                      double highest) {
  if (!value.is_number())
    owner.fail(key, std::string("is ") + described(value) + ", not a number",
               "write a number " + range(lowest, highest));
  const double number = value.get<double>();
  // Written so that NaN fails too.
  if (!(number >= lowest && number <= highest))
    owner.fail(key, "is " + shown_number(number) + ", out of range",
               "write a number " + range(lowest, highest));
  return number;
}

}  // namespace

std::string shown_number(double value) {
  std::array<char, 32> buffer;  // 17 digits, sign, point and exponent
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), result.ptr);
}

std::int64_t line_of_field(const std::filesystem::path& file, const std::string& field) {
  constexpr std::int64_t kMostBytes = 16 << 20;
  try {
    return json_line(read_whole_file(file, kMostBytes), field);
  } catch (const InputError&) {
  } catch (const std::system_error&) {
  }
  return 0;  // the error itself matters more than its line
}

JsonObject::JsonObject(const json& value, std::filesystem::path file, std::string where, std::int64_t line)
    : value_(&value), file_(std::move(file)), where_(std::move(where)), line_(line) {
  if (!value.is_object())
    fail(nullptr, std::string("is ") + described(value) + ", not an object", "write {...}");
}

void JsonObject::fail(const char* key, const std::string& problem, const std::string& remedy) const {
  std::string field = where_;
  if (key != nullptr) field += (field.empty() ? "" : ".") + std::string(key);
  throw InputError(file_, line_ > 0 ? line_ : line_of_field(file_, field),
                   (field.empty() ? "the document" : "field " + printable(field)) + " " + problem, remedy);
}

void JsonObject::allow_only(std::initializer_list<const char*> keys) const {
  const std::vector<std::string> known(keys.begin(), keys.end());
  for (const auto& [key, value] : value_->items()) {
    bool found = false;
    for (const std::string& name : known) found = found || name == key;
    if (!found) fail(printable(key).c_str(), "is not known", key_remedy(key, known));
  }
}

bool JsonObject::has(const char* key) const {
  return value_->contains(key);
}

const json& JsonObject::value(const char* key) const {
  const auto found = value_->find(key);
  if (found == value_->end()) fail(key, "is missing", "add it");
  return *found;
}

double JsonObject::number(const char* key, double lowest, double highest) const {
  return checked_number(*this, key, value(key), lowest, highest);
}

double JsonObject::number_or(const char* key, double lowest, double highest, double fallback) const {
  return has(key) ? number(key, lowest, highest) : fallback;
}

std::int64_t JsonObject::integer(const char* key, std::int64_t lowest, std::int64_t highest) const {
  const json& found = value(key);
  // No number is right where a list that it counts into is empty.
  const bool none = highest < lowest;
  const std::string remedy =
      none ? "remove it, or add what it names"
           : "write a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest);
  if (!found.is_number()) fail(key, std::string("is ") + described(found) + ", not a whole number", remedy);
  // 1.0, 1e3 and anything past 2^64 arrive as floating point, where digits may already be lost.
  if (!found.is_number_integer())
    fail(key, "is " + shown_number(found.get<double>()) + ", not a whole number in range", remedy);
  constexpr auto kLargest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  const bool too_large = found.is_number_unsigned() && found.get<std::uint64_t>() > kLargest;
  const std::int64_t number = too_large ? 0 : found.get<std::int64_t>();
  if (too_large || number < lowest || number > highest) {
    const std::string digits =
        too_large ? std::to_string(found.get<std::uint64_t>()) : std::to_string(number);
    fail(key, "is " + digits + (none ? ", and there is none that it could name" : ", out of range"), remedy);
  }
  return number;
}

std::int64_t JsonObject::integer_or(const char* key, std::int64_t lowest, std::int64_t highest,
                                    std::int64_t fallback) const {
  return has(key) ? integer(key, lowest, highest) : fallback;
}

void JsonObject::require_version(std::int64_t version) const {
  constexpr const char* kKey = "format_version";
  const std::string wanted = std::to_string(version);
  if (!has(kKey)) fail(kKey, "is missing", "add \"format_version\": " + wanted);
  const json& found = value(kKey);
  if (found.is_number_integer() && found == version) return;
  if (!found.is_number())
    fail(kKey, std::string("is ") + described(found) + ", not a number", "write " + wanted);
  fail(kKey, "is " + shown_number(found.get<double>()) + ", and this program reads version " + wanted,
       "use a newer herr, or write " + wanted);
}

bool JsonObject::boolean_or(const char* key, bool fallback) const {
  if (!has(key)) return fallback;
  const json& found = value(key);
  if (!found.is_boolean()) fail(key, std::string("is ") + described(found), "write true or false");
  return found.get<bool>();
}

std::string JsonObject::text(const char* key) const {
  const json& found = value(key);
  if (!found.is_string()) fail(key, std::string("is ") + described(found) + ", not a text", "write \"...\"");
  std::string text = found.get<std::string>();
  // "\u0000" is legal JSON, yet ends a path or a name early wherever C strings are used.
  if (text.find('\0') != std::string::npos) fail(key, "holds a NUL character", "remove it");
  return text;
}

std::string JsonObject::text_or(const char* key, const std::string& fallback) const {
  return has(key) ? text(key) : fallback;
}

std::vector<double> JsonObject::numbers(const char* key, std::size_t count, double lowest,
                                        double highest) const {
  const json& found = value(key);
  const std::string remedy = "write an array of " + std::to_string(count) + " numbers";
  if (!found.is_array()) fail(key, std::string("is ") + described(found) + ", not an array", remedy);
  if (found.size() != count) fail(key, "has " + std::to_string(found.size()) + " elements", remedy);
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string element = std::string(key) + "[" + std::to_string(i) + "]";
    values.push_back(checked_number(*this, element.c_str(), found[i], lowest, highest));
  }
  return values;
}

glm::dvec3 JsonObject::vec3(const char* key, double lowest, double highest) const {
  const std::vector<double> values = numbers(key, 3, lowest, highest);
  return {values[0], values[1], values[2]};
}

glm::dvec3 JsonObject::vec3_or(const char* key, double lowest, double highest,
                               const glm::dvec3& fallback) const {
  return has(key) ? vec3(key, lowest, highest) : fallback;
}

std::array<double, 4> JsonObject::unit_quaternion(const char* key) const {
  constexpr double kTolerance = 1e-3, kDegrees = 3, kLargest = 1e9;
  const std::string remedy =
      "write a unit quaternion x, y, z, w: [0, 0, 0, 1] is no turn, [0, 0.7071068, 0, 0.7071068] one of 90 "
      "degrees about y";
  const json& found = value(key);
  if (found.is_array() && found.size() != 4)
    fail(key, "has " + std::to_string(found.size()) + " elements", remedy);
  const std::vector<double> q = numbers(key, 4, -kLargest, kLargest);
  const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (std::abs(length - 1) <= kTolerance) return {q[0], q[1], q[2], q[3]};
  std::string text;
  bool large = false;
  for (const double number : q) {
    text += (text.empty() ? "[" : ", ") + shown_number(number);
    large = large || std::abs(number) > kDegrees;
  }
  fail(key,
       "is " + text + "], not of unit length but " + shown_number(std::round(1e4 * length) / 1e4) +
           (large ? ", as if degrees stood in it" : ""),
       remedy);
}

bool JsonObject::is_number(const char* key) const {
  return value(key).is_number();
}

bool JsonObject::is_text(const char* key) const {
  return value(key).is_string();
}

JsonObject JsonObject::object(const char* key) const {
  return {value(key), file_, (where_.empty() ? "" : where_ + ".") + key, line_};
}

std::vector<JsonObject> JsonObject::objects(const char* key) const {
  std::vector<JsonObject> views;
  if (!has(key)) return views;
  const json& found = value(key);
  if (!found.is_array())
    fail(key, std::string("is ") + described(found) + ", not an array", "write [{...}, ...]");
  const std::string prefix = (where_.empty() ? "" : where_ + ".") + key;
  for (std::size_t i = 0; i < found.size(); ++i)
    views.emplace_back(found[i], file_, prefix + "[" + std::to_string(i) + "]", line_);
  return views;
}

JsonDocument::JsonDocument(std::filesystem::path file, const JsonLimits& limits)
    : file_(std::move(file)), value_(std::make_unique<const json>(parse_json_file(file_, limits))) {}

JsonDocument::JsonDocument(std::string_view text, std::filesystem::path file, std::int64_t line)
    : file_(std::move(file)),
      value_(std::make_unique<const json>(parse_json_text(text, file_, line))),
      line_(line) {}

JsonDocument::JsonDocument(JsonDocument&&) noexcept = default;
JsonDocument::~JsonDocument() = default;

bool JsonDocument::is_object() const {
  return value_->is_object();
}

JsonObject JsonDocument::root() const {
  return {*value_, file_, "", line_};
}

}  // namespace herr
