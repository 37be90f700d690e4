// An XML file cut into rows by libexpat, in bounded memory. Before: InputFile. After: xml_rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace herr {

class XmlCutter {
 public:
  // `row_element`: its name, without a namespace. `learn`: every path becomes a place as it comes.
  XmlCutter(const std::filesystem::path& file, std::string row_element, bool learn);
  ~XmlCutter();

  // The place of a path; values come from the next row on.
  std::size_t place(std::string_view path);

  // Goes to the next row; false at the end. Throws InputError for a row with a fault, after which the next
  // one follows, and for a file with a fault, after which there is none.
  bool next();
  const std::vector<std::string>& values() const;  // by place; empty where the row has no such path
  const std::vector<std::string>& paths() const;   // by place
  std::int64_t line() const;                       // where the row begins
  std::string cut_off() const;  // what follows the last whole row of a file that ends early
  const std::vector<std::string>& other_elements() const;  // outside rows, some of them

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace herr
