// Rows of an XML file, one element a row: attributes and texts of it and of what it holds, by their paths.
// Namespaces are ignored. Before: InputFile, read in blocks by libexpat. After: rows/.
// Document types and entities are refused; depth, names, values and rows are bounded.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sessions/import/tables/row_source.h"

namespace herr {

class XmlCutter;

class XmlRows : public RowSource {
 public:
  // Reads some rows to learn what there is, and begins again. Throws InputError.
  XmlRows(const std::filesystem::path& file, const TableFormat& format, std::span<const ColumnRef> wanted);
  ~XmlRows() override;

  bool has(const ColumnRef& column) const override;
  std::size_t place(const ColumnRef& column) override;
  bool next() override;

 private:
  void learn(const TableFormat& format, std::span<const ColumnRef> wanted);

  std::string row_element_;
  std::vector<std::string> known_;  // paths of the first rows
  std::unique_ptr<XmlCutter> cutter_;
};

}  // namespace herr
