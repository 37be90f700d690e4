// Pieces of a report's page: HTML without scripts that loads nothing. Text is plain and escaped here; content
// and bodies are HTML already. Before: tables and records. After: study_page, stability_page.
#pragma once

#include <string>
#include <vector>

#include "server/study/report/report_table.h"
#include "server/study/report/study_record.h"

namespace herr {

// These four give nothing without content. Pictures are enlarged by whole pixels while they stay within
// `enlarged_px`.
std::string page_section(const std::string& id, const std::string& title, const std::string& content);
std::string page_table(const ReportTable& table, bool caption = true);
std::string page_list(const std::vector<std::string>& lines);
std::string page_pictures(const std::vector<StudyPicture>& pictures, int enlarged_px = 0);

// Broken between its words, as far as they fit into a line: not at hyphens.
std::string page_code(const std::string& text);

// The whole file.
std::string page_document(const std::string& title, const std::string& body);

}  // namespace herr
