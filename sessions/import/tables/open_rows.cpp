#include "sessions/import/tables/delimited_table.h"
#include "sessions/import/tables/row_source.h"
#include "sessions/import/tables/xml_rows.h"

namespace herr {

std::unique_ptr<RowSource> open_rows(const std::filesystem::path& file, const TableFormat& format,
                                     std::span<const ColumnRef> wanted) {
  if (!format.xml_row.empty()) return std::make_unique<XmlRows>(file, format, wanted);
  return std::make_unique<DelimitedTable>(file, format, wanted);
}

}  // namespace herr
