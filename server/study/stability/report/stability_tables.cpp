#include "server/study/stability/report/stability_tables.h"

#include <algorithm>
#include <initializer_list>

#include "server/study/report/figure_text.h"
#include "server/study/stability/report/stability_verdict.h"

namespace herr {
namespace {

std::string group_title(const std::string& name) {
  for (const RelationGroup& group : relation_groups()) {
    if (group.name == name) return name + ": " + group.sentence;
  }
  return name;
}

std::vector<std::string> relation_row(const RelationResult& result) {
  const Relation& relation = result.relation;
  return {relation.name,
          name_of(relation.kind),
          result.asked() ? error_figure(result.error) : kNoFigure,
          bound_figure(relation.bound),
          share_text(result),
          relation.unit,
          verdict_text(result),
          fixed_figure(result.seconds, 1),
          relation.holds + ". Bound: " + relation.bound_from,
          result.asked() ? result.where : result.not_applicable};
}

ReportTable group_table(const std::string& group, std::vector<const RelationResult*> results) {
  std::stable_partition(results.begin(), results.end(),
                        [](const RelationResult* result) { return !result->holds(); });
  ReportTable table{group_title(group),
                    {{"relation", true},
                     {"kind", true},
                     {"error"},
                     {"bound"},
                     {"of bound"},
                     {"unit", true},
                     {"verdict", true},
                     {"s"},
                     {"what must hold, and where the bound is from", true, true},
                     {"worst place, or why it was not asked", true, true}},
                    {},
                    ""};
  for (const RelationResult* result : results) table.rows.push_back(relation_row(*result));
  return table;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> stability_facts(const StabilityRecord& record) {
  std::vector<std::pair<std::string, std::string>> facts;
  const auto add = [&](const char* name, std::initializer_list<std::string> parts) {
    std::string value;
    for (const std::string& part : parts) value += (part.empty() || value.empty() ? "" : ", ") + part;
    if (!value.empty()) facts.push_back({name, value});
  };
  const auto counted = [](std::int64_t count, const char* what) {
    return count > 0 ? std::to_string(count) + " " + what : std::string();
  };
  add("Session", {record.session});
  add("Scene", {record.scene, counted(record.triangles, "triangles")});
  add("Profile", {record.profile, record.viewports});
  add("Machine", {record.cpu, record.isa, counted(record.threads, "threads")});
  add("Frame", {std::to_string(record.frame.number), "at " + fixed_figure(record.frame.time_s, 2) + " s",
                "head at " + fixed_figure(record.frame.head_deg_per_s, 1) + "\u00b0/s",
                "gaze " + fixed_figure(record.frame.gaze_deg, 1) + "\u00b0 from straight ahead"});
  add("Settings", {record.settings});
  add("Asked",
      {std::to_string(record.results.size()) + " relations in " + fixed_figure(record.seconds, 0) + " s"});
  add("Program", {record.program});
  return facts;
}

std::vector<ReportTable> group_tables(const StabilityRecord& record) {
  std::vector<std::string> names;
  for (const RelationResult& result : record.results) {
    if (std::find(names.begin(), names.end(), result.group) == names.end()) names.push_back(result.group);
  }
  std::vector<ReportTable> tables;
  for (const std::string& name : names) {
    std::vector<const RelationResult*> results;
    for (const RelationResult& result : record.results) {
      if (result.group == name) results.push_back(&result);
    }
    tables.push_back(group_table(name, std::move(results)));
  }
  return tables;
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
