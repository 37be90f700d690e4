#include "sessions/import/tables/table_sample.h"

#include <algorithm>

#include "sessions/files/input_error.h"
#include "sessions/files/line_reader.h"
#include "sessions/streams/field_text.h"

namespace herr {
namespace {

// What no first line of a table holds.
void refuse_other_files(const TableSample& sample, const TextLine& line) {
  if (const auto nuls = std::count(line.text.begin(), line.text.end(), '\0'); nuls > 0) {
    const bool wide = static_cast<std::size_t>(nuls) * 3 > line.text.size();
    throw InputError(sample.path, line.number,
                     wide ? "is UTF-16 without a byte-order mark" : "holds NUL bytes: is it a table of text?",
                     wide ? "save it as UTF-8" : "name a recording, or copy it again");
  }
  if (line.too_long)
    throw InputError(sample.path, line.number,
                     "the line is longer than " + std::to_string(kMostLineBytes) + " bytes",
                     "name a table of text");
  if (!line.whole && line.text.find('\r') != std::string_view::npos)
    throw InputError(sample.path, line.number, "ends its lines with CR alone", "save it with LF or CRLF");
  if (const std::string_view start = trimmed(line.text);
      start.starts_with("<?xml") || start.starts_with("<!"))
    throw InputError(sample.path, line.number, "is XML, not a table with separators",
                     "name the element of a row in the map (\"xml\"), or the right preset");
}

}  // namespace

TableSample read_table_sample(const std::filesystem::path& file, const TableFormat& format,
                              std::size_t lines) {
  TableSample sample{file, {}, false, 0};
  LineReader reader(file, kMostLineBytes);
  if (reader.empty()) throw InputError(file, 0, "is empty", "name a recording");
  TextLine line;
  const auto headers =
      static_cast<std::int64_t>(format.header && format.header_lines > 1 ? format.header_lines : 0);
  while (sample.lines.size() < lines + static_cast<std::size_t>(headers)) {
    if (!reader.next(line)) {
      sample.whole_file = true;
      break;
    }
    if (sample.lines.empty()) refuse_other_files(sample, line);
    if (!line.whole) {
      sample.cut_off_line = line.number;
      sample.whole_file = true;
      break;
    }
    std::string_view text = trimmed(line.text);
    if (text.empty() || line.too_long || text.find('\0') != std::string_view::npos) continue;
    const bool comment = !format.comment.empty() && text.starts_with(format.comment);
    // Leading blanks count where tabs separate: the first field may be empty.
    text = comment ? trimmed(text.substr(format.comment.size())) : line.text;
    if (comment && line.number > headers && !sample.lines.empty() && sample.lines.back().comment)
      sample.lines.pop_back();
    sample.lines.push_back({std::string(text), line.number, comment});
  }
  return sample;
}

}  // namespace herr
