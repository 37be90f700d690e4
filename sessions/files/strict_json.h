// JSON with the strictness that a tool needs on untrusted files: sizes and depth are bounded, duplicate keys,
// NUL bytes and numbers out of range are errors, and an unknown key names its nearest known neighbour.
// Who only reads fields needs JsonDocument and JsonObject, and not the library's header.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace herr {

struct JsonLimits {
  std::int64_t max_bytes = 64 << 20;
  int max_depth = 64;
  std::int64_t max_values = 2'000'000;
};

// Parses a whole file / one text. Throws InputError with the line of the first error.
nlohmann::json parse_json_file(const std::filesystem::path& file, const JsonLimits& limits = {});
nlohmann::json parse_json_text(std::string_view text, const std::filesystem::path& file,
                               std::int64_t first_line, const JsonLimits& limits = {});

// The line of a file of JSON on which a field stands ("lights[0].path"); of one that is missing, the line of
// what it should stand in. 0: the file cannot be read again, or is no JSON. It parses the file: of use for
// errors.
std::int64_t line_of_field(const std::filesystem::path& file, const std::string& field);

// The shortest text that reads back as the same number: two that differ look different in a message.
std::string shown_number(double value);

// A view of one JSON object that knows where it stands ("lights[0].path"), so that each error names its
// field and its line. The document must outlive the view. Every reader throws InputError on a wrong type,
// range or size.
class JsonObject {
 public:
  // `line`: where the whole document stands on one line of the file; 0: it is all of the file.
  JsonObject(const nlohmann::json& value, std::filesystem::path file, std::string where,
             std::int64_t line = 0);

  // Throws if a key is present that is not listed here; names the nearest listed key.
  void allow_only(std::initializer_list<const char*> keys) const;
  bool has(const char* key) const;
  bool is_number(const char* key) const;  // throws when it is missing
  bool is_text(const char* key) const;

  double number(const char* key, double lowest, double highest) const;
  double number_or(const char* key, double lowest, double highest, double fallback) const;
  // highest = lowest - 1, as for an index into an empty list: always an error, which says so.
  std::int64_t integer(const char* key, std::int64_t lowest, std::int64_t highest) const;
  std::int64_t integer_or(const char* key, std::int64_t lowest, std::int64_t highest,
                          std::int64_t fallback) const;
  // "format_version": throws unless it is the one version that is read.
  void require_version(std::int64_t version) const;
  bool boolean_or(const char* key, bool fallback) const;
  std::string text(const char* key) const;
  std::string text_or(const char* key, const std::string& fallback) const;
  glm::dvec3 vec3(const char* key, double lowest, double highest) const;
  glm::dvec3 vec3_or(const char* key, double lowest, double highest, const glm::dvec3& fallback) const;
  std::vector<double> numbers(const char* key, std::size_t count, double lowest, double highest) const;
  JsonObject object(const char* key) const;
  std::vector<JsonObject> objects(const char* key) const;  // an array of objects; empty when absent
  const nlohmann::json& value(const char* key) const;

  // Four numbers x, y, z, w whose length is 1 to a thousandth, as they are written.
  std::array<double, 4> unit_quaternion(const char* key) const;

  const std::filesystem::path& file() const { return file_; }
  const std::string& where() const { return where_; }
  // Throws InputError "FILE:LINE: field WHERE.KEY PROBLEM; REMEDY" (KEY may be null: the object itself).
  [[noreturn]] void fail(const char* key, const std::string& problem, const std::string& remedy) const;

 private:
  const nlohmann::json* value_;
  std::filesystem::path file_;
  std::string where_;
  std::int64_t line_ = 0;
};

// A parsed document, which its views look into.
class JsonDocument {
 public:
  // Parses a whole file / one line of a file, as parse_json_file and parse_json_text do.
  explicit JsonDocument(std::filesystem::path file, const JsonLimits& limits = {});
  JsonDocument(std::string_view text, std::filesystem::path file, std::int64_t line);
  JsonDocument(JsonDocument&&) noexcept;
  JsonDocument& operator=(JsonDocument&&) = delete;
  ~JsonDocument();

  bool is_object() const;
  JsonObject root() const;  // throws InputError unless it is an object

 private:
  std::filesystem::path file_;
  std::unique_ptr<const nlohmann::json> value_;
  std::int64_t line_ = 0;  // that all of it stands on; 0: on several
};

}  // namespace herr
