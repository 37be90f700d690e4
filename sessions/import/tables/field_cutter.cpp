#include "sessions/import/tables/field_cutter.h"

#include <algorithm>

#include "sessions/streams/field_text.h"

namespace herr {
namespace {

// The end of a field that begins with a quote: the first separator behind the closing one ("" is a quote
// within).
std::size_t quoted_end(std::string_view text, std::size_t quote, char separator) {
  std::size_t at = text.find('"', quote + 1);
  while (at != std::string_view::npos && text.substr(at + 1).starts_with('"')) at = text.find('"', at + 2);
  if (at == std::string_view::npos) return text.size();
  return std::min(separator == ' ' ? text.find_first_of(" \t", at) : text.find(separator, at), text.size());
}

}  // namespace

bool take_field(std::string_view& rest, char separator, std::string_view& field) {
  const bool blanks = separator == ' ';
  const std::size_t first = rest.find_first_not_of(separator == '\t' ? " " : " \t");
  if (blanks) rest.remove_prefix(std::min(first, rest.size()));
  const std::size_t start = blanks ? 0 : first;
  const bool quoted = start < rest.size() && rest[start] == '"';
  const std::size_t end =
      quoted ? quoted_end(rest, start, separator)
             : std::min(blanks ? rest.find_first_of(" \t") : rest.find(separator), rest.size());
  field = trimmed(rest.substr(0, end));
  rest.remove_prefix(end);
  if (quoted && field.size() >= 2 && field.back() == '"') field = trimmed(field.substr(1, field.size() - 2));
  if (blanks) rest = trimmed(rest);
  if (rest.empty()) return false;
  if (!blanks) rest.remove_prefix(1);
  return true;
}

void cut_fields(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  std::string_view field;
  bool more = true;
  while (more) {
    more = take_field(line, separator, field);
    fields.push_back(field);
  }
}

std::size_t filled_fields(const std::vector<std::string_view>& fields) {
  std::size_t count = fields.size();
  while (count > 0 && fields[count - 1].empty()) --count;
  return count;
}

const char* separator_name(char separator) {
  switch (separator) {
    case ';':
      return "semicolons";
    case '\t':
      return "tabs";
    case ' ':
      return "blanks";
    default:
      return "commas";
  }
}

const char* separator_key(char separator) {
  switch (separator) {
    case ';':
      return ";";
    case '\t':
      return "tab";
    case ' ':
      return "spaces";
    default:
      return ",";
  }
}

}  // namespace herr
