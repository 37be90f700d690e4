#include "sessions/import/tables/xml_rows.h"

#include <algorithm>

#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/files/nearest_name.h"
#include "sessions/import/tables/number_text.h"
#include "sessions/import/tables/xml_cutter.h"
#include "sessions/streams/field_text.h"

namespace herr {
namespace {

constexpr int kLearnedRows = 64;

}  // namespace

XmlRows::XmlRows(const std::filesystem::path& file, const TableFormat& format,
                 std::span<const ColumnRef> wanted)
    : RowSource(file, format.decimal == 0 ? '.' : format.decimal), row_element_(format.xml_row) {
  if (InputFile(file).size_bytes() == 0) throw InputError(file, 0, "is empty", "name a recording");
  learn(format, wanted);
  cutter_ = std::make_unique<XmlCutter>(file, row_element_, false);
}

XmlRows::~XmlRows() = default;

void XmlRows::learn(const TableFormat& format, std::span<const ColumnRef> wanted) {
  XmlCutter first(path_, row_element_, true);
  int rows = 0;
  std::int64_t points = 0, commas = 0;
  bool more = true;
  while (rows < kLearnedRows && more) {
    try {
      more = first.next();
    } catch (const InputError&) {
      if (rows == 0) throw;
      break;  // it comes again where it belongs
    }
    rows += more ? 1 : 0;
    for (std::size_t place = 0; more && place < first.paths().size(); ++place) {
      const std::string& value = first.values()[place];
      const bool asked = std::any_of(wanted.begin(), wanted.end(), [&](const ColumnRef& column) {
        return column.name == first.paths()[place];
      });
      if (!asked || value.empty()) continue;
      points += reads_as_number(trimmed(value), '.') ? 1 : 0;
      commas += reads_as_number(trimmed(value), ',') ? 1 : 0;
    }
  }
  known_ = first.paths();
  if (format.decimal == 0 && commas > points) decimal_ = ',';
  if (rows > 0) return;
  const std::string nearest = nearest_name(row_element_, first.other_elements());
  if (!first.cut_off().empty())
    throw InputError(path_, 0, "ends before its first element <" + row_element_ + "> does",
                     "copy the file again");
  throw InputError(
      path_, 0,
      "has no element <" + row_element_ + ">" + (nearest.empty() ? "" : " (is it <" + nearest + ">?)"),
      "name the element of a row in the map (\"xml\"), or the right preset");
}

bool XmlRows::has(const ColumnRef& column) const {
  return column.number == 0 && std::find(known_.begin(), known_.end(), column.name) != known_.end();
}

std::size_t XmlRows::place(const ColumnRef& column) {
  if (column.number > 0)
    throw InputError(path_, 0, "is XML, of which a column has no number",
                     "write its path below <" + row_element_ + "> in the map, as \"Pose@Position\"");
  if (!has(column)) {
    const std::string nearest = nearest_name(column.name, known_);
    throw InputError(path_, 0,
                     "has no " + in_quotes(column.name) + " in its elements <" + row_element_ + ">" +
                         (nearest.empty() ? "" : " (is it " + in_quotes(nearest) + "?)"),
                     "check the preset, or write a map");
  }
  const std::size_t place = cutter_->place(column.name);
  names_ = cutter_->paths();
  fields_.resize(names_.size());
  return place;
}

bool XmlRows::next() {
  bool more = false;
  try {
    more = cutter_->next();
  } catch (const InputError&) {
    line_ = cutter_->line();
    throw;
  }
  line_ = cutter_->line();
  if (!more) {
    cut_off_ = cutter_->cut_off();
    return false;
  }
  for (std::size_t place = 0; place < fields_.size(); ++place) {
    std::string_view value = cutter_->values()[place];
    while (!value.empty() && static_cast<unsigned char>(value.back()) <= ' ') value.remove_suffix(1);
    while (!value.empty() && static_cast<unsigned char>(value.front()) <= ' ') value.remove_prefix(1);
    fields_[place] = value;
  }
  return true;
}

}  // namespace herr
