#include "server/study/stability/report/stability_page.h"

#include <vector>

#include "server/diagrams/html_text.h"
#include "server/study/report/page_parts.h"
#include "server/study/stability/report/stability_tables.h"
#include "server/study/stability/report/stability_verdict.h"

namespace herr {
namespace {

constexpr int kShownWidthPx = 1000;  // small pictures are enlarged up to it

std::string facts_part(const StabilityRecord& record) {
  std::string facts;
  const auto fact = [&](const std::string& name, const std::string& value) {
    facts += html_element("dt", "", name) + html_element("dd", "", value) + "\n";
  };
  for (const auto& [name, value] : stability_facts(record)) fact(name, html_text(value));
  if (!record.command_line.empty()) fact("Again", page_code(record.command_line));
  if (!record.warnings.empty()) {
    fact("Warnings", html_element("a", "href=\"#warnings\"", std::to_string(record.warnings.size())));
  }
  return html_element("dl", "class=\"facts\"", facts) + "\n";
}

std::string verdict_part(const StabilityRecord& record) {
  const RelationCounts counts = counts_of(record.results);
  const bool fails = counts.fail > 0;
  std::string items = html_element("li", fails ? "class=\"missed\"" : "",
                                   html_element("b", "", fails ? "Does not hold: " : "Holds: ") +
                                       html_text(counts_text(counts))) +
                      "\n";
  for (const std::string& line : failure_lines(record)) {
    items += html_element("li", "class=\"missed\"", html_text(line)) + "\n";
  }
  return html_element("ul", "class=\"aims\"", items) + "\n" +
         html_element("p", "", "Closest to its limit: " + html_text(closest_text(record.results)) + ".") +
         "\n";
}

std::string groups_part(const StabilityRecord& record) {
  std::string tables;
  for (const ReportTable& table : page_tables(record)) tables += page_table(table);
  return tables;
}

std::string sentences_part(const StabilityRecord& record) {
  std::string items;
  for (const RelationSentence& one : relation_sentences(record)) {
    items +=
        html_element("dt", "", html_text(one.names)) + html_element("dd", "", html_text(one.sentence)) + "\n";
  }
  return items.empty() ? "" : html_element("dl", "class=\"metrics\"", items) + "\n";
}

std::string stability_body(const StabilityRecord& record) {
  return html_element("h1", "", "Relations that must hold: " + html_text(record.scene)) + "\n" +
         facts_part(record) + page_section("verdict", "Verdict", verdict_part(record)) +
         page_section("relations", "Relations", groups_part(record)) +
         page_section("pictures", "What the worst look like", page_pictures(record.pictures, kShownWidthPx)) +
         page_section("not-applicable", "Not applicable", page_list(not_applicable_lines(record))) +
         page_section("sentences", "What must hold, and where bounds are from", sentences_part(record)) +
         page_section("warnings", "Warnings", page_list(record.warnings));
}

}  // namespace

std::string stability_page(const StabilityRecord& record) {
  return page_document("Relations that must hold: " + record.scene, stability_body(record));
}

}  // namespace herr
