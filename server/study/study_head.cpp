#include "server/study/study_head.h"

#include "server/bench/bench_subject.h"
#include "server/process/version.h"
#include "server/settings/run_settings.h"
#include "server/study/plan/study_setting.h"
#include "server/text/number_text.h"
#include "server/text/shell_word.h"

namespace herr {
namespace {

std::string only_flag(const StudyOptions& options) {
  std::string text;
  for (const std::string& name : options.only) text += (text.empty() ? " --only " : ",") + name;
  return text;
}

std::string command_line_of(const StudyOptions& options) {
  std::string text = "herr study " + std::string(options.stability ? "--stability " : "") +
                     shell_word(options.session.string());
  if (!options.scene.empty()) text += " --scene " + shell_word(options.scene);
  for (const std::filesystem::path& root : options.asset_roots)
    text += " --asset-root " + shell_word(root.string());
  text += " --profile " + shell_word(options.profile);
  if (options.profile_scale != 1) text += " --profile-scale " + shortest_text(options.profile_scale);
  const std::string flags = flags_text(changes_between(RenderSettings{}, options.render));
  if (!flags.empty()) text += " " + flags;
  if (!options.stability) {
    text += " --frames " + std::to_string(options.frames) + " --minutes " + shortest_text(options.minutes);
  }
  return text + only_flag(options) + (options.reading.strict ? " --strict" : "");
}

}  // namespace

ReportHead report_head_of(const StudyOptions& options, const SessionReport& report) {
  ReportHead head;
  head.program = program_with_version();
  head.command_line = command_line_of(options);
  head.session = report.header.name;
  head.scene = report.scene_name;
  head.profile = profile_words(report.profile.name, options.profile_scale);
  head.cpu = cpu_name();
  head.isa = name_of(report.settings.isa);
  head.triangles = report.scene_triangles;
  head.threads = report.settings.threads;
  return head;
}

}  // namespace herr
