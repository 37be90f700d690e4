#include "server/study/measure/study_row.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>

#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// A column: its name, and how a cell is written and read. Reading throws std::invalid_argument.
struct Column {
  std::string name;
  std::function<std::string(const StudyRow&)> write;
  std::function<void(StudyRow&, const std::string&)> read;
};

std::string cell_of(double value) {
  return std::isfinite(value) ? shortest_text(value) : "";
}

double number_of(const std::string& cell) {
  if (cell.empty()) return kNone;
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size()) throw std::invalid_argument("no number");
  return value;
}

std::int64_t count_of(const std::string& cell) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size()) throw std::invalid_argument("no count");
  return value;
}

std::string cells_of(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ";") + cell_of(value);
  return text;
}

std::vector<double> numbers_of(const std::string& cell) {
  std::vector<double> values;
  for (std::size_t at = 0; at < cell.size();) {
    const std::size_t end = std::min(cell.find(';', at), cell.size());
    values.push_back(number_of(cell.substr(at, end - at)));
    at = end + 1;
  }
  return values;
}

Column text_column(const char* name, std::string StudyRow::*text) {
  return {name, [=](const StudyRow& row) { return row.*text; },
          [=](StudyRow& row, const std::string& cell) { row.*text = cell; }};
}

Column number_column(const char* name, double StudyRow::*number) {
  return {name, [=](const StudyRow& row) { return cell_of(row.*number); },
          [=](StudyRow& row, const std::string& cell) { row.*number = number_of(cell); }};
}

Column list_column(const char* name, std::vector<double> StudyRow::*list) {
  return {name, [=](const StudyRow& row) { return cells_of(row.*list); },
          [=](StudyRow& row, const std::string& cell) { row.*list = numbers_of(cell); }};
}

void add_errors(const std::string& prefix, std::optional<ErrorTable> StudyRow::*table,
                std::vector<Column>& columns) {
  for (std::size_t band = 0; band < kBands; ++band) {
    for (std::size_t metric = 0; metric < kMetrics; ++metric) {
      columns.push_back({prefix + metric_rows()[metric].name + "_" + bands()[band].name,
                         [=](const StudyRow& row) {
                           return row.*table ? cell_of((*(row.*table)).value[band][metric]) : "";
                         },
                         [=](StudyRow& row, const std::string& cell) {
                           if (cell.empty()) return;
                           if (!(row.*table)) row.*table = ErrorTable();
                           (*(row.*table)).value[band][metric] = number_of(cell);
                         }});
    }
  }
}

void add_flicker(const std::string& name, std::array<double, kBands> Flicker::*values,
                 std::vector<Column>& columns) {
  for (std::size_t band = 0; band < kBands; ++band) {
    columns.push_back(
        {"flicker_" + name + "_" + bands()[band].name,
         [=](const StudyRow& row) { return row.flicker ? cell_of(((*row.flicker).*values)[band]) : ""; },
         [=](StudyRow& row, const std::string& cell) {
           if (cell.empty()) return;
           if (!row.flicker) {
             row.flicker.emplace();
             for (auto* all : {&row.flicker->test, &row.flicker->reference, &row.flicker->excess}) {
               all->fill(kNone);
             }
           }
           ((*row.flicker).*values)[band] = number_of(cell);
         }});
  }
}

std::vector<Column> make_columns() {
  std::vector<Column> columns{text_column("name", &StudyRow::name),
                              text_column("knob", &StudyRow::knob),
                              text_column("base", &StudyRow::base),
                              text_column("value", &StudyRow::value),
                              number_column("n", &StudyRow::n),
                              text_column("flags", &StudyRow::flags),
                              {"frame", [](const StudyRow& row) { return std::to_string(row.frame); },
                               [](StudyRow& row, const std::string& cell) { row.frame = count_of(cell); }},
                              number_column("frame_ms", &StudyRow::frame_ms),
                              number_column("pixels_ms", &StudyRow::pixels_ms),
                              number_column("calibration_ms", &StudyRow::calibration_ms),
                              number_column("pairs_cpu_ms", &StudyRow::cpu_ms),
                              number_column("pairs_cores_ms", &StudyRow::cores_ms),
                              number_column("pairs_preemptions", &StudyRow::preemptions),
                              list_column("ln_time_ratios", &StudyRow::log_ratios),
                              list_column("ln_work_ratios", &StudyRow::work_log_ratios),
                              text_column("reference", &StudyRow::reference)};
  add_errors("", &StudyRow::error, columns);
  columns.push_back(text_column("own_reference", &StudyRow::own_reference));
  add_errors("own_", &StudyRow::own_error, columns);
  columns.push_back({"bias_rmse", [](const StudyRow& row) { return row.bias ? cell_of(*row.bias) : ""; },
                     [](StudyRow& row, const std::string& cell) {
                       if (!cell.empty()) row.bias = number_of(cell);
                     }});
  FrameCounters any;
  for_each_counter(any, [&](const std::string& name, std::int64_t&) {
    columns.push_back({name,
                       [=](const StudyRow& row) {
                         std::string text;
                         for_each_counter(row.counters,
                                          [&](const std::string& other, const std::int64_t& count) {
                                            if (other == name) text = std::to_string(count);
                                          });
                         return text;
                       },
                       [=](StudyRow& row, const std::string& cell) {
                         for_each_counter(row.counters, [&](const std::string& other, std::int64_t& count) {
                           if (other == name) count = count_of(cell);
                         });
                       }});
  });
  add_flicker("test", &Flicker::test, columns);
  add_flicker("reference", &Flicker::reference, columns);
  add_flicker("excess", &Flicker::excess, columns);
  columns.push_back(number_column("measuring_s", &StudyRow::seconds));
  return columns;
}

const std::vector<Column>& all_columns() {
  static const std::vector<Column> columns = make_columns();
  return columns;
}

// RFC 4180: cells with commas or quotes stand in quotes.
std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

std::vector<std::string> cells_in(std::string_view line) {
  std::vector<std::string> cells(1);
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (inside && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += c, ++i;
    } else if (c == '"') {
      inside = !inside;
    } else if (c == ',' && !inside) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

}  // namespace

std::string study_csv_header() {
  std::string text;
  for (const Column& column : all_columns()) text += (text.empty() ? "" : ",") + column.name;
  return text + "\n";
}

std::string study_csv_row(const StudyRow& row) {
  std::string text;
  bool first = true;
  for (const Column& column : all_columns()) {
    if (!first) text += ',';
    first = false;
    text += quoted(column.write(row));
  }
  return text + "\n";
}

std::optional<StudyRow> study_row_of(std::string_view line) {
  const std::vector<std::string> cells = cells_in(line);
  const std::vector<Column>& columns = all_columns();
  if (cells.size() != columns.size()) return std::nullopt;
  StudyRow row;
  try {
    for (std::size_t i = 0; i < cells.size(); ++i) columns[i].read(row, cells[i]);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
  return row;
}

}  // namespace herr
