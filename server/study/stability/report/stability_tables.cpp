#include "server/study/stability/report/stability_tables.h"

#include <algorithm>
#include <initializer_list>

#include "server/study/report/figure_text.h"
#include "server/study/report/report_facts.h"
#include "server/study/stability/report/stability_verdict.h"

namespace herr {
namespace {

std::string group_title(const std::string& name) {
  for (const RelationGroup& group : relation_groups()) {
    if (group.name == name) return name + ": " + group.sentence;
  }
  return name;
}

using Results = std::vector<const RelationResult*>;

// By group, in the order of the record; within one, what fails first.
std::vector<Results> grouped(const StabilityRecord& record) {
  std::vector<Results> groups;
  for (const RelationResult& result : record.results) {
    const auto same = [&](const Results& group) { return group.front()->group == result.group; };
    const auto found = std::find_if(groups.begin(), groups.end(), same);
    if (found == groups.end()) {
      groups.push_back({&result});
    } else {
      found->push_back(&result);
    }
  }
  for (Results& group : groups) {
    std::stable_partition(group.begin(), group.end(),
                          [](const RelationResult* result) { return !result->holds(); });
  }
  return groups;
}

ReportTable page_table_of(const Results& results) {
  ReportTable table{group_title(results.front()->group),
                    {{"verdict", true},
                     {"relation", true},
                     {"kind", true},
                     {"error"},
                     {"bound"},
                     {"of bound"},
                     {"s"},
                     {"unit", true}},
                    {},
                    ""};
  for (const RelationResult* result : results) {
    const Relation& relation = result->relation;
    table.rows.push_back({verdict_text(*result), relation.name, name_of(relation.kind),
                          result->asked() ? error_figure(result->error) : kNoFigure,
                          bound_figure(relation.bound), share_text(*result), fixed_figure(result->seconds, 1),
                          relation.unit});
  }
  return table;
}

// Characters that begin within the first `most` bytes.
std::string short_unit(const std::string& unit, std::size_t most) {
  if (unit.size() <= most) return unit;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(unit[end]) & 0xC0) == 0x80) --end;
  return unit.substr(0, end) + "..";
}

template <typename Value>
bool all_alike(const Results& results, const Value& value) {
  return std::all_of(results.begin(), results.end(),
                     [&](const RelationResult* result) { return value(*result) == value(*results.front()); });
}

// What names leave to units, of about 118 columns; names are cut only where they leave less than this.
std::size_t room_for_units(const Results& results, bool one_kind) {
  constexpr std::size_t kLeastUnit = 24;
  const std::size_t names_and_units = one_kind ? 74 : 61;
  std::size_t longest = 0;
  for (const RelationResult* result : results) longest = std::max(longest, result->relation.name.size());
  return names_and_units - std::min(longest, names_and_units - kLeastUnit);
}

ReportTable terminal_table_of(const Results& results) {
  const Relation& first = results.front()->relation;
  const bool one_kind = all_alike(results, [](const RelationResult& result) { return result.relation.kind; });
  const bool one_unit = all_alike(results, [](const RelationResult& result) { return result.relation.unit; });
  ReportTable table{group_title(results.front()->group) +
                        (one_kind ? std::string(" (") + name_of(first.kind) + ")" : "") +
                        (one_unit ? "; error: " + first.unit : ""),
                    {{"verdict", true}, {"relation", true}, {"error"}, {"bound"}, {"of bound"}},
                    {},
                    ""};
  if (!one_kind) table.columns.push_back({"kind", true});
  if (!one_unit) table.columns.push_back({"unit", true});
  for (const RelationResult* result : results) {
    const Relation& relation = result->relation;
    table.rows.push_back({result->holds()    ? "holds"
                          : result->counts() ? "FAILS"
                                             : "fails",
                          relation.name, error_figure(result->error), bound_figure(relation.bound),
                          share_text(*result)});
    if (!one_kind) table.rows.back().push_back(name_of(relation.kind));
    if (!one_unit) table.rows.back().push_back(short_unit(relation.unit, room_for_units(results, one_kind)));
  }
  return table;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> stability_facts(const StabilityRecord& record) {
  ReportFacts facts;
  facts.add_head(record, record.viewports);
  facts.add("Frame",
            {std::to_string(record.frame.number), "at " + fixed_figure(record.frame.time_s, 2) + " s",
             "head at " + fixed_figure(record.frame.head_deg_per_s, 1) + "\u00b0/s",
             "gaze " + fixed_figure(record.frame.gaze_deg, 1) + "\u00b0 from straight ahead"});
  facts.add("Settings", {record.settings});
  facts.add("Asked", {std::to_string(record.results.size()) + " relations in " +
                      fixed_figure(record.seconds, 0) + " s"});
  facts.add("Program", {record.program});
  return facts.take();
}

std::vector<ReportTable> page_tables(const StabilityRecord& record) {
  std::vector<ReportTable> tables;
  for (const Results& group : grouped(record)) tables.push_back(page_table_of(group));
  return tables;
}

std::vector<ReportTable> terminal_tables(const StabilityRecord& record) {
  std::vector<ReportTable> tables;
  for (Results group : grouped(record)) {
    std::erase_if(group, [](const RelationResult* result) { return !result->asked(); });
    if (!group.empty()) tables.push_back(terminal_table_of(group));
  }
  return tables;
}

std::vector<RelationSentence> relation_sentences(const StabilityRecord& record) {
  std::vector<RelationSentence> sentences;
  std::string group;
  for (const RelationResult& result : record.results) {
    const std::string sentence = result.relation.holds + ". Bound: " + result.relation.bound_from + ".";
    const bool goes_on = !sentences.empty() && group == result.group && sentences.back().sentence == sentence;
    if (goes_on) {
      sentences.back().names += "; " + result.relation.name;
    } else {
      sentences.push_back({result.group + ": " + result.relation.name, sentence});
    }
    group = result.group;
  }
  return sentences;
}

std::vector<std::string> not_applicable_lines(const StabilityRecord& record) {
  std::vector<std::string> lines;
  for (const RelationResult& result : record.results) {
    if (result.asked()) continue;
    lines.push_back(result.group + ": " + result.relation.name + ": " + result.not_applicable);
  }
  return lines;
}

std::vector<std::string> failure_lines(const StabilityRecord& record) {
  std::vector<std::string> lines;
  for (const RelationResult* result : worst_first(record.results)) {
    if (!result->holds()) lines.push_back(failure_line(*result));
  }
  return lines;
}

}  // namespace herr
