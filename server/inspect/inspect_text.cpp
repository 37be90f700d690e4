#include "server/inspect/inspect_text.h"

#include "server/inspect/scene_text.h"
#include "server/inspect/session_text.h"
#include "server/replay/summary_json.h"
#include "server/statistics/number_text.h"
#include "sessions/input_error.h"

namespace herr {
namespace {

std::string plan_text(const InspectReport& report) {
  if (!report.plan) return "";
  std::string text = "frame plan (" + settings_text(report.settings) + ")\n";
  for (const PlanEntry& entry : report.plan->entries) {
    // Without a session nobody knows.
    const bool open = !report.session && entry.name == "camera composite" && report.settings.camera;
    text += "  " + left_aligned(entry.runs ? "runs" : "skipped", 9) + left_aligned(entry.name, 23) +
            (open ? "no session is inspected" : entry.reason) + "\n";
  }
  return text + "\n";
}

std::string plural(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string findings_text(const FindingList& findings) {
  std::string text = plural(findings.count(Severity::error), "error") + ", " +
                     plural(findings.count(Severity::warning), "warning") + ", " +
                     plural(findings.count(Severity::note), "note") + "\n";
  for (const Finding& finding : findings.sorted()) {
    text += left_aligned(name_of(finding.severity), 9) + finding.text() + "\n";
    if (finding.count > 1) text += std::string(9, ' ') + finding.rest() + "\n";
  }
  return text;
}

std::string verdict(const InspectReport& report) {
  if (report.sound()) return report.session ? "sound: replay takes it\n" : "sound: it can be rendered\n";
  const std::int64_t errors = report.findings.count(Severity::error);
  const std::int64_t skippable = report.findings.skippable_errors();
  if (skippable < errors) return "not sound: replay refuses it\n";
  return "not sound: replay refuses it; with --keep-going it leaves out " +
         (skippable == 1 ? "1 row" : std::to_string(skippable) + " rows") + "\n";
}

}  // namespace

std::string inspect_text(const InspectReport& report) {
  std::string text;
  if (report.session) text += session_text(report);
  if (report.scene) text += scene_text(report);
  return text + plan_text(report) + findings_text(report.findings) + verdict(report);
}

}  // namespace herr
