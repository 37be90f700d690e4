// Facts at the head of a report: names and values, parts between commas, nothing without content. Before: a
// record. After: page and text.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "server/study/report/study_record.h"

namespace herr {

class ReportFacts {
 public:
  void add(const char* name, std::initializer_list<std::string> parts);
  // Session, scene, profile (with `viewports`, which may be empty) and machine.
  void add_head(const ReportHead& head, const std::string& viewports = {});
  std::vector<std::pair<std::string, std::string>> take() { return std::move(facts_); }

 private:
  std::vector<std::pair<std::string, std::string>> facts_;
};

}  // namespace herr
