#include "server/study/stability/report_again.h"

#include <nlohmann/json.hpp>
#include <string>

#include "server/process/exit_code.h"
#include "server/process/terminal.h"
#include "server/results/summary_json.h"
#include "server/study/report/study_json.h"
#include "server/study/report/study_page.h"
#include "server/study/report/study_text.h"
#include "server/study/stability/report/stability_json.h"
#include "server/study/stability/report/stability_page.h"
#include "server/study/stability/report/stability_text.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

constexpr JsonLimits kReportLimits{256 << 20, 64, 4'000'000};

void print_stability_again(const StudyOptions& options, const nlohmann::json& document) {
  const StabilityRecord record = read_stability(document, options.report.string());
  if (!options.page.empty()) write_whole_file(options.page, stability_page(record));
  print_result(options.json ? json_text(stability_json(record)) : stability_text(record));
}

void print_study_again(const StudyOptions& options, const nlohmann::json& document) {
  const StudyRecord record = read_study(document, options.report.string());
  if (!options.page.empty()) write_whole_file(options.page, study_page(record));
  print_result(options.json ? json_text(study_json(record)) : study_text(record));
}

}  // namespace

int print_report_again(const StudyOptions& options) {
  const nlohmann::json document = parse_json_file(options.report, kReportLimits);
  if (is_stability_json(document)) {
    print_stability_again(options, document);
  } else if (options.stability) {
    throw InputError(options.report, 0, "is no stability report", "give a stability.json");
  } else {
    print_study_again(options, document);
  }
  return kExitDone;
}

}  // namespace herr
