#include "server/inspect/inspect_text.h"

#include <algorithm>

#include "server/inspect/acuity/acuity_text.h"
#include "server/inspect/mirror_words.h"
#include "server/inspect/scene_text.h"
#include "server/inspect/session_text.h"
#include "server/results/settings_report.h"
#include "server/results/summary_json.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

std::string plan_text(const InspectReport& report) {
  if (!report.plan) return "";
  std::string text = "frame plan (" + settings_text(report.settings, report.has_camera_feed()) + ")\n";
  int widest = 0;
  for (const PlanEntry& entry : report.plan->entries)
    widest = std::max(widest, static_cast<int>(entry.name.size()));
  for (const PlanEntry& entry : report.plan->entries) {
    // Without a session nobody knows.
    const bool by_session = entry.name == "camera composite" || entry.name == kMirroredFeed;
    const bool open = !report.session && by_session && report.settings.camera;
    text += "  " + left_aligned(entry.runs ? "runs" : "skipped", 9) + left_aligned(entry.name, widest + 2) +
            (open ? "no session is inspected" : entry.reason) + "\n";
  }
  return text + "\n";
}

std::string mirrors_text(const InspectReport& report) {
  const std::vector<std::string> words = mirror_words(report);
  std::string text;
  for (const std::string& sentence : words) text += "  " + sentence + "\n";
  return text.empty() ? "" : "mirrors and glass\n" + text + "\n";
}

std::string findings_text(const FindingList& findings) {
  std::string text = counted(findings.kinds(Severity::error), "error", "errors") + ", " +
                     counted(findings.kinds(Severity::warning), "warning", "warnings") + ", " +
                     counted(findings.kinds(Severity::note), "note", "notes") + "\n";
  for (const Finding& finding : findings.sorted()) {
    text += left_aligned(name_of(finding.severity), 9) + finding.text() + "\n";
    if (finding.count > 1) text += std::string(9, ' ') + finding.rest() + "\n";
  }
  return text;
}

std::string verdict(const InspectReport& report) {
  if (report.sound() && !report.session) return "sound: it can be rendered\n";
  if (report.sound())
    return report.scene ? "sound: replay takes it\n" : "sound: replay takes it, with --scene FILE\n";
  const std::int64_t errors = report.findings.count(Severity::error);
  const std::int64_t skippable = report.findings.skippable_errors();
  if (!report.session) return "not sound: it cannot be rendered\n";
  if (skippable < errors) return "not sound: replay refuses it\n";
  return "not sound: replay refuses it; with --keep-going it leaves out " +
         counted(skippable, "row", "rows") + "\n";
}

}  // namespace

std::string inspect_text(const InspectReport& report) {
  std::string text;
  if (report.session) text += session_text(report);
  if (report.scene) text += scene_text(report);
  text += plan_text(report);
  // Of what cannot be rendered it would only push the error out of sight.
  if (report.acuity && report.sound()) text += acuity_text(*report.acuity);
  if (!report.acuity_plot.empty())
    text += "the plot as a picture: " + printable(report.acuity_plot.string()) + "\n\n";
  text += mirrors_text(report);
  if (report.probes) text += probe_dump_text(*report.probes);
  return text + findings_text(report.findings) + verdict(report);
}

}  // namespace herr
