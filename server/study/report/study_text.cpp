#include "server/study/report/study_text.h"

#include <string>
#include <vector>

#include "server/study/report/report_table.h"
#include "server/study/report/study_tables.h"

namespace herr {
namespace {

constexpr int kTerminalColumns = 118;
constexpr int kListIndent = 4;

std::string text_line(const std::string& text) {
  return wrapped_text(text, kTerminalColumns, kListIndent) + "\n";
}

std::string text_list(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return {};
  std::string text = title + "\n";
  for (const std::string& line : lines) text += text_line("  " + line);
  return text + "\n";
}

std::vector<std::string> aim_lines(const StudyRecord& record) {
  std::vector<std::string> lines;
  for (const bool met : {false, true}) {
    for (const StudyAim& aim : record.aims) {
      if (aim.met == met) lines.push_back((met ? "met: " : "MISSED: ") + aim_text(aim));
    }
  }
  return lines;
}

std::string subject_lines(const StudyRecord& record) {
  std::string text;
  for (const auto& [name, value] : study_facts(record)) text += text_line(name + ": " + value);
  return text + "\n";
}

std::string text_section(const ReportTable& table) {
  return table.rows.empty() ? "" : table_text(table, kTerminalColumns) + "\n";
}

}  // namespace

std::string study_text(const StudyRecord& record) {
  std::vector<std::string> advice, remarks;
  if (!record.advice.empty() && !record.advice_note.empty()) advice.push_back(record.advice_note);
  for (const StudyAdvice& line : record.advice) advice.push_back(line.sentence);
  for (const StudyRemark& remark : record.remarks) remarks.push_back(remark.knob + ": " + remark.text);
  std::string text = record.no_advice.empty() ? "" : text_line(record.no_advice) + "\n";
  text += subject_lines(record) + text_list("Aims", aim_lines(record)) + text_list("Recommendation", advice) +
          text_section(front_table(record));
  for (const ReportTable& table : point_tables(record)) text += text_section(table);
  if (!record.points.empty()) text += wrapped_text(kTimesNote, kTerminalColumns) + "\n\n";
  text += text_section(fit_table(record)) + text_section(reference_table(record)) +
          text_section(flicker_table(record));
  return text + text_list("Dropped for want of time", record.dropped) +
         text_list("Left out: nothing in the scene for them", record.left_out) +
         text_list("Remarks", remarks) + text_list("Warnings", record.warnings);
}

}  // namespace herr
