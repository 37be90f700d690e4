#include "server/study/stability/report/stability_text.h"

#include <vector>

#include "server/study/report/figure_text.h"
#include "server/study/report/report_table.h"
#include "server/study/stability/report/stability_tables.h"
#include "server/study/stability/report/stability_verdict.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

constexpr int kReportColumns = 118;
constexpr int kReportIndent = 4;

std::string report_line(const std::string& text) {
  return wrapped_text(text, kReportColumns, kReportIndent) + "\n";
}

std::string report_list(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return {};
  std::string text = title + "\n";
  for (const std::string& line : lines) text += report_line("  " + line);
  return text + "\n";
}

}  // namespace

std::string stability_text(const StabilityRecord& record) {
  std::string text;
  for (const auto& [name, value] : stability_facts(record)) text += report_line(name + ": " + value);
  text += "\n" + report_list("Does not hold", failure_lines(record));
  for (const ReportTable& table : terminal_tables(record)) text += table_text(table, kReportColumns) + "\n";
  text +=
      report_list("Not applicable", not_applicable_lines(record)) + report_list("Warnings", record.warnings);
  return text + report_line("Closest to its limit: " + closest_text(record.results)) +
         report_line("Verdict: " + counts_text(counts_of(record.results)) + "; " +
                     counted(static_cast<std::int64_t>(record.results.size()), "relation", "relations") +
                     " in " + fixed_figure(record.seconds, 0) + " s");
}

}  // namespace herr
