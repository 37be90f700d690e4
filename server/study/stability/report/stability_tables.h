// The parts of a stability report that page and terminal share. Before: StabilityRecord. After:
// stability_page, stability_text.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "server/study/report/report_table.h"
#include "server/study/stability/report/stability_record.h"

namespace herr {

// What was asked, of what and how long, by name; without what is not known.
std::vector<std::pair<std::string, std::string>> stability_facts(const StabilityRecord& record);

// One of each group, in order: what fails first, then as they were asked. The title is the sentence of
// relation_groups(), where that still has the group.
std::vector<ReportTable> page_tables(const StabilityRecord& record);
// The same for a terminal, where a relation's name goes first: without those that were not asked, and the
// kind and unit in the title where they are the same of all.
std::vector<ReportTable> terminal_tables(const StabilityRecord& record);

// What must hold and where its bound is from, of relations in a row that say the same.
struct RelationSentence {
  std::string names;  // "place: moved by 1e3 m; moved by 1e6 m"
  std::string sentence;
};
std::vector<RelationSentence> relation_sentences(const StabilityRecord& record);

// "place: moved by 1e6 m: why", of those that were not asked.
std::vector<std::string> not_applicable_lines(const StabilityRecord& record);
// failure_line() of each, worst first.
std::vector<std::string> failure_lines(const StabilityRecord& record);

}  // namespace herr
