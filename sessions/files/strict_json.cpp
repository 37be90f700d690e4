#include "sessions/files/strict_json.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/files/json/traced_text.h"

namespace herr {
namespace {

using nlohmann::json;

// Builds the document while it checks what nlohmann's own builder lets pass: depth, count, repeated keys.
class CheckedBuilder : public nlohmann::json_sax<json> {
 public:
  CheckedBuilder(const JsonLimits& limits, json& root) : limits_(limits), root_(root) {}

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t&) override { return stop("holds binary data"); }
  bool start_object(std::size_t) override { return open(json::object()); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    if (parents_.back()->contains(name))
      return stop("key '" + printable(name) + "' stands twice in one object");
    key_ = std::move(name);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) override {
    const std::string text = error.what();
    // The library's text begins with its own counting of lines, which starts at 1 in every
    // text: ours replaces it.
    const std::size_t start = text.find("syntax error");
    is_syntax_ = start != std::string::npos;
    return stop("is not JSON: " +
                (start == std::string::npos ? text.substr(text.find("] ") + 2) : text.substr(start)));
  }

  const std::string& problem() const { return problem_; }
  bool is_syntax() const { return is_syntax_; }  // of the problem

 private:
  bool stop(std::string problem) {
    problem_ = std::move(problem);
    return false;
  }
  template <typename Value>
  bool add(Value&& value) {
    return place(json(std::forward<Value>(value))) != nullptr;
  }
  json* place(json value) {
    if (++values_ > limits_.max_values) {
      stop("holds more than " + std::to_string(limits_.max_values) + " values");
      return nullptr;
    }
    if (parents_.empty()) return &(root_ = std::move(value));
    json& parent = *parents_.back();
    if (parent.is_object()) return &(parent[key_] = std::move(value));
    parent.push_back(std::move(value));
    return &parent.back();
  }
  bool open(json container) {
    if (static_cast<int>(parents_.size()) >= limits_.max_depth)
      return stop("is nested deeper than " + std::to_string(limits_.max_depth) + " levels");
    json* placed = place(std::move(container));
    if (placed == nullptr) return false;
    parents_.push_back(placed);
    return true;
  }
  bool close() {
    parents_.pop_back();
    return true;
  }

  JsonLimits limits_;
  json& root_;
  std::vector<json*> parents_;
  std::string key_, problem_;
  std::int64_t values_ = 0;
  bool is_syntax_ = false;
};

struct Mistake {
  std::string problem, remedy;
};

bool is_word_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' || c == '-' ||
         c == '.' || c == '_';
}

// The word or number without quotes in which `offset` lies.
std::string word_around(std::string_view text, std::size_t offset) {
  std::size_t from = offset, to = offset;
  while (from > 0 && is_word_letter(text[from - 1])) --from;
  while (to < text.size() && is_word_letter(text[to])) ++to;
  return std::string(text.substr(from, to - from));
}

std::string in_lower_case(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return word;
}

// What other languages and programs write and JSON does not take, at the character where the parser stopped.
std::optional<Mistake> usual_mistake(std::string_view text, std::size_t offset) {
  const char at = text[offset];
  if (at == '}' || at == ']') {
    const std::size_t before = offset > 0 ? text.find_last_not_of(" \t\r\n", offset - 1) : std::string::npos;
    if (before != std::string::npos && text[before] == ',')
      return Mistake{std::string("a comma stands before '") + at + "'", "remove that comma"};
  }
  const std::string_view bytes = text.substr(offset, 3);
  if (bytes.starts_with("\xe2\x80") && bytes.size() == 3 && bytes[2] >= '\x98' && bytes[2] <= '\x9f')
    return Mistake{"it has typographic quotes", "write \""};
  if (at == '\'') return Mistake{"a text stands in ' '", "write it in \" \""};
  if (at == '/' || at == '#') return Mistake{"it has no comments", "remove this one"};
  const std::string word = word_around(text, offset), lower = in_lower_case(word);
  const std::string magnitude = lower.substr(lower.starts_with('-') || lower.starts_with('+') ? 1 : 0);
  if (magnitude == "nan" || magnitude == "inf" || magnitude == "infinity")
    return Mistake{"it has no " + word, "write a finite number such as 0, or leave the field out"};
  if (lower == "true" || lower == "false") return Mistake{"it has no " + word, "write " + lower};
  if (lower == "none" || lower == "undefined") return Mistake{"it has no " + word, "write null"};
  if (magnitude.starts_with('.') || (word.starts_with('+') && word.size() > 1))
    return Mistake{"it has no number " + printable(word),
                   "write " + printable((lower.starts_with('-') ? "-" : "") +
                                        ((magnitude.starts_with('.') ? "0" : "") + magnitude))};
  return std::nullopt;
}

std::int64_t lines_before(std::string_view text, std::size_t offset) {
  return std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size())),
                    '\n');
}

// Where another value or key begins in place of a comma: the parser has read a text to its closing quote.
std::optional<Mistake> missing_comma(std::string_view text, std::size_t offset, const std::string& problem,
                                     std::int64_t first_line) {
  const bool ends =
      problem.find("expected '}'") != std::string::npos || problem.find("expected ']'") != std::string::npos;
  if (!ends || problem.find("expected end of input") != std::string::npos || offset == 0) return std::nullopt;
  std::size_t begin = offset;
  if (text[offset] == '"') {
    begin = text.rfind('"', offset - 1);
    while (begin != std::string_view::npos && begin > 0 && text[begin - 1] == '\\')
      begin = text.rfind('"', begin - 1);
  } else if (text[offset] != '{') {
    return std::nullopt;
  }
  if (begin == std::string_view::npos || begin == 0) return std::nullopt;
  const std::size_t end = text.find_last_not_of(" \t\r\n", begin - 1);
  if (end == std::string_view::npos) return std::nullopt;
  const std::int64_t of_value = first_line + lines_before(text, end),
                     of_next = first_line + lines_before(text, begin);
  const std::string next =
      text[begin] == '{' ? "'{'" : printable(std::string(text.substr(begin, offset - begin + 1)));
  return Mistake{"a comma is missing " +
                     (of_value == of_next ? "before " + next : "after line " + std::to_string(of_value)),
                 "write ',' there"};
}

void refuse_foreign_encodings(std::string_view text, const std::filesystem::path& file,
                              std::int64_t first_line) {
  if (text.substr(0, 2) == "\xff\xfe" || text.substr(0, 2) == "\xfe\xff")
    throw InputError(file, first_line, "is UTF-16", "save it as UTF-8");
  // The parser takes NUL for the end of the text and would ignore what follows.
  const std::size_t nul = text.find('\0');
  if (nul != std::string_view::npos)
    throw InputError(file, first_line + lines_before(text, nul), "holds a NUL byte",
                     "save it as UTF-8 text; a file full of NUL bytes was damaged by a crash");
}

}  // namespace

json parse_json_text(std::string_view text, const std::filesystem::path& file, std::int64_t first_line,
                     const JsonLimits& limits) {
  if (static_cast<std::int64_t>(text.size()) > limits.max_bytes)
    throw InputError(file, first_line, "has more than " + std::to_string(limits.max_bytes) + " bytes of JSON",
                     "check that this is the right file");
  refuse_foreign_encodings(text, file, first_line);
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw InputError(file, first_line, "is empty", "write a JSON value");
  json root;
  CheckedBuilder builder(limits, root);
  const char* reached = text.data();
  const TracedText first(text.data(), &reached), last(text.data() + text.size(), &reached);
  if (json::sax_parse(first, last, &builder)) return root;
  // The parser reads one character past a number, which may be the end of its line.
  const auto read = static_cast<std::size_t>(reached - text.data());
  const std::size_t offset = read > 0 ? read - 1 : 0;
  const std::int64_t line = first_line + lines_before(text, offset);
  if (const auto mistake = builder.is_syntax() ? usual_mistake(text, offset) : std::nullopt)
    throw InputError(file, line, "is not JSON: " + mistake->problem, mistake->remedy);
  if (const auto mistake =
          builder.is_syntax() ? missing_comma(text, offset, builder.problem(), first_line) : std::nullopt)
    throw InputError(file, line, "is not JSON: " + mistake->problem, mistake->remedy);
  throw InputError(file, line, builder.problem(), "correct the file");
}

json parse_json_file(const std::filesystem::path& file, const JsonLimits& limits) {
  return parse_json_text(read_whole_file(file, limits.max_bytes), file, 1, limits);
}

}  // namespace herr
