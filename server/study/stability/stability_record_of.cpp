#include "server/study/stability/stability_record_of.h"

#include <utility>

#include "server/results/settings_report.h"
#include "server/study/stability/report/stability_pictures.h"
#include "server/study/study_head.h"

namespace herr {
namespace {

std::string sizes_of(const DisplayProfile& profile) {
  std::string text;
  for (const Viewport& viewport : profile.viewports) {
    text += (text.empty() ? "" : ", ") + viewport.name + " " + std::to_string(viewport.width_px) + "x" +
            std::to_string(viewport.height_px);
  }
  return text;
}

}  // namespace

StabilityRecord stability_record_of(const StudyOptions& options, const StabilityCase& subject,
                                    std::vector<RelationResult> results, double seconds) {
  const SessionReport& report = subject.report();
  const RelationCase& asked = subject.relations();
  StabilityRecord record;
  static_cast<ReportHead&>(record) = report_head_of(options, report);
  record.settings = settings_text(asked.settings, asked.camera);
  record.viewports = sizes_of(asked.profile);
  record.frame = subject.frame();
  record.seconds = seconds;
  record.warnings = subject.warnings();
  record.pictures = worst_shown(results);
  record.results = std::move(results);
  for (RelationResult& result : record.results) result.pictures.reset();
  return record;
}

}  // namespace herr
