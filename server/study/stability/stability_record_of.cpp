#include "server/study/stability/stability_record_of.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/bench/bench_subject.h"
#include "server/process/version.h"
#include "server/results/settings_report.h"
#include "server/study/report/difference_picture.h"
#include "server/study/stability/stability_verdict.h"
#include "server/study/study_command_line.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr std::size_t kMostShown = 3;
constexpr int kShownPanelPx = 300;
constexpr int kMostGainBits = 20;  // differences of 1e-6 of white fill the ramp

std::string sizes_of(const DisplayProfile& profile) {
  std::string text;
  for (const Viewport& viewport : profile.viewports) {
    text += (text.empty() ? "" : ", ") + viewport.name + " " + std::to_string(viewport.width_px) + "x" +
            std::to_string(viewport.height_px);
  }
  return text;
}

// The largest power of two at which no difference leaves the ramp.
double gain_for(const RelationPictures& pictures) {
  double largest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<float>&got = pictures.got.plane[c], &wanted = pictures.wanted.plane[c];
    for (std::size_t i = 0; i < std::min(got.size(), wanted.size()); ++i) {
      const double apart = std::abs(double{got[i]} - double{wanted[i]});
      if (std::isfinite(apart)) largest = std::max(largest, apart);
    }
  }
  if (!(largest > 0)) return 1;
  return std::exp2(std::clamp(std::floor(-std::log2(largest)), 0.0, double{kMostGainBits}));
}

StudyPicture picture_of_result(const RelationResult& result) {
  const RelationPictures& pictures = *result.pictures;
  const double gain = gain_for(pictures);
  StudyPicture picture = difference_picture(result.group + ": " + result.relation.name, pictures.got,
                                            pictures.wanted, gain, kShownPanelPx);
  picture.caption = pictures.caption + ". " + verdict_text(result) + ": error " + error_figure(result.error) +
                    ", bound " + error_figure(result.relation.bound) + " (" + result.relation.unit +
                    "). The difference is that of the brightest channel times " + shortest_text(gain) +
                    ", from black over red and yellow to white.";
  if (!result.where.empty()) picture.caption += " Worst: " + result.where + ".";
  return picture;
}

std::vector<StudyPicture> worst_shown(const std::vector<RelationResult>& results) {
  std::vector<StudyPicture> shown;
  for (const RelationResult* result : worst_first(results)) {
    if (shown.size() < kMostShown && result->pictures) shown.push_back(picture_of_result(*result));
  }
  return shown;
}

}  // namespace

StabilityRecord stability_record_of(const StudyOptions& options, const StabilityCase& subject,
                                    std::vector<RelationResult> results, double seconds) {
  const SessionReport& report = subject.report();
  const RelationCase& asked = subject.relations();
  StabilityRecord record;
  record.program = program_with_version();
  record.command_line = study_command_line(options);
  record.session = report.header.name;
  record.scene = report.scene_name;
  record.profile = report.profile.name;
  record.cpu = cpu_name();
  record.isa = name_of(report.settings.isa);
  record.triangles = report.scene_triangles;
  record.threads = report.settings.threads;
  record.settings = settings_text(asked.settings);
  record.viewports = sizes_of(asked.profile);
  record.frame = subject.frame();
  record.seconds = seconds;
  record.warnings = report.warnings;
  record.pictures = worst_shown(results);
  record.results = std::move(results);
  for (RelationResult& result : record.results) result.pictures.reset();
  return record;
}

}  // namespace herr
