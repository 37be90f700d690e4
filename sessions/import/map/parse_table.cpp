// How a map's rows are cut into fields, and which pictures' rows there are.
#include <nlohmann/json.hpp>

#include "sessions/import/map/map_parts.h"

namespace herr {
namespace {

constexpr std::int64_t kMostHeaderLines = 1000;

void parse_header(const JsonObject& entry, TableFormat& table) {
  table.header = entry.boolean_or("header", true);
  if (!table.header) refuse_beside(entry, "header false", {"header_lines", "names_line"});
  const std::int64_t lines = entry.integer_or("header_lines", 1, kMostHeaderLines, 1);
  const std::int64_t names = entry.integer_or("names_line", 1, kMostHeaderLines, 1);
  if (names > lines)
    entry.fail("names_line",
               "is " + std::to_string(names) + ", beyond the header's " + std::to_string(lines) +
                   (lines == 1 ? " line" : " lines"),
               "write in header_lines how many lines come before the rows");
  table.header_lines = static_cast<std::size_t>(lines);
  table.names_line = static_cast<std::size_t>(names);
}

std::string separator_text(const JsonObject& entry) {
  const std::string text = entry.text_or("separator", ",");
  if (text == "\t") return "tab";
  return text == " " ? "spaces" : text;
}

char parse_separator(const JsonObject& entry) {
  const std::string text = separator_text(entry);
  for (const auto& [word, separator] : kSeparatorWords)
    if (text == word) return separator;
  return parse_word(entry, "separator", kSeparatorWords);
}

}  // namespace

TableFormat parse_table(const JsonObject& entry) {
  TableFormat table;
  table.decimal = parse_word(entry, "decimal", kDecimalWords, ".");
  if (entry.has("xml")) {
    table.xml_row = entry.text("xml");
    if (table.xml_row.empty()) entry.fail("xml", "is empty", "write the name of the element that is a row");
    refuse_beside(entry, "xml", {"separator", "comment", "header", "header_lines", "names_line", "ragged"});
    return table;
  }
  table.separator = parse_separator(entry);
  if (table.separator == ',' && table.decimal == ',')
    entry.fail("decimal", "is ',' as the separator is", "write the file's separator, such as \";\"");
  table.comment = entry.text_or("comment", "");
  table.ragged = entry.boolean_or("ragged", false);
  parse_header(entry, table);
  return table;
}

CameraColumns parse_camera(const JsonObject& entry) {
  entry.allow_only({"separator", "decimal", "comment", "header", "header_lines", "names_line", "ragged",
                    "xml", "time", "file"});
  CameraColumns camera;
  camera.table = parse_table(entry);
  camera.time = parse_time(entry);
  if (entry.has("file")) camera.file = parse_ref(entry, "file");
  return camera;
}

}  // namespace herr
