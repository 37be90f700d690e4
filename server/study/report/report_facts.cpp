#include "server/study/report/report_facts.h"

#include <cstdint>

namespace herr {
namespace {

std::string count_fact(std::int64_t count, const char* what) {
  return count > 0 ? std::to_string(count) + " " + what : std::string();
}

}  // namespace

void ReportFacts::add(const char* name, std::initializer_list<std::string> parts) {
  std::string value;
  for (const std::string& part : parts) value += (part.empty() || value.empty() ? "" : ", ") + part;
  if (!value.empty()) facts_.push_back({name, value});
}

void ReportFacts::add_head(const ReportHead& head, const std::string& viewports) {
  add("Session", {head.session});
  add("Scene", {head.scene, count_fact(head.triangles, "triangles")});
  add("Profile", {head.profile, viewports});
  add("Machine", {head.cpu, head.isa, count_fact(head.threads, "threads")});
}

}  // namespace herr
