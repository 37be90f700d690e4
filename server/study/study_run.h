// A study from its first reference to its last row: what is there from an earlier run is kept. Before:
// subject and folder. After: study_record makes the report of it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/process/steady_time.h"
#include "server/study/measure/measure_setting.h"
#include "server/study/measure/references.h"
#include "server/study/measure/study_row.h"
#include "server/study/plan/knobs.h"
#include "server/study/plan/short_plan.h"
#include "server/study/study_folder.h"
#include "server/study/study_progress.h"
#include "server/study/study_state.h"
#include "server/study/study_subject.h"
#include "sessions/files/append_file.h"

namespace herr {

class StudyRun {
 public:
  // All must outlive it; `sweeps` are those of the subject that are wanted. The minutes count from
  // `started_ns`. Reads what an earlier run left (options.resume). Throws InputError where that is of another
  // study.
  StudyRun(const StudyOptions& options, StudySubject& subject, StudySweeps sweeps, const StudyFolder& folder,
           TimeNs started_ns);

  // False: a signal asked for the end; what was measured stands in the folder. Throws as the renderer and
  // WriteError.
  bool measure();

  const std::vector<StudyRow>& rows() const { return rows_; }
  const StudyState& state() const { return state_; }
  const StudySweeps& sweeps() const { return sweeps_; }
  std::vector<std::string> dropped() const;
  const std::vector<std::string>& warnings() const { return warnings_; }
  double seconds() const;  // earlier runs included
  // "3 of 74 settings measured: no recommendation; give --minutes 12 or more (...)" where so little was
  // measured that a choice among it would be none; else empty.
  std::string no_advice() const;
  // `frame`: whose rows are measured against them; none for pictures that no row needs.
  References::Context reference_context(std::optional<std::int64_t> frame = {});

 private:
  static constexpr double kShareOfReferences = 0.5;
  static constexpr double kReportSeconds = 10;  // at the end, for pictures and pages
  static constexpr int kClipPasses = 4;         // of a half of each frame's reference

  void read_rows();
  void make_references();
  bool has_time_for_references(std::size_t frame) const;
  bool references_are_coarse(double two_passes_s);
  bool shares_anew() const;
  void share_time();
  StudyBudget plan_of(double seconds);
  void tell_plan();
  void measure_left_over(double until_s);
  void measure_bases();
  double minutes_for_advice() const;
  void measure_settings(const std::vector<StudySetting>& settings, std::size_t frames, double until_s);
  void measure_frame(const std::vector<StudySetting>& settings, std::int64_t frame, double until_s);
  void choose_combinations();
  void measure_flicker();
  void keep(StudyRow row);
  bool is_noted(const std::string& name, std::int64_t frame) const;
  void note(const References& references, std::int64_t frame);
  bool is_measured(const std::string& name, std::int64_t frame) const;
  bool is_measured_everywhere(const StudySetting& setting) const;
  const StudyRow* row_of(const std::string& name, std::int64_t frame) const;
  std::vector<StudySetting> wanted_settings() const;
  double estimated_seconds(const StudySetting& setting) const;
  std::vector<SettingCost> costs(const std::vector<StudySetting>& settings) const;
  double share_of_frames(const StudySetting& setting) const;
  double reference_seconds(const StudySetting& setting) const;
  double seconds_of_frame(const RenderSettings& of) const;
  double expected_seconds(const StudySetting& setting) const;
  double limit_s() const { return 60 * options_.minutes; }
  MeasuringRules measuring_rules() const;
  double clip_seconds() const;
  double seconds_of_rows() const;
  double pixel_references_s() const;
  double until_clip_s() const;

  const StudyOptions& options_;
  StudySubject& subject_;
  const StudyFolder& folder_;
  StudySweeps sweeps_;
  StudyState state_;
  std::vector<StudyRow> rows_;
  std::vector<std::string> warnings_, out_of_time_;
  std::optional<AppendFile> csv_;
  ReferenceCache cache_;
  StudyProgress progress_;
  double earlier_s_ = 0;
  TimeNs start_ns_, last_row_ns_, reference_start_ns_;
  double references_s_ = 0;            // that those over pixels may take, so far
  std::optional<bool> coarse_;         // known after the first pass of the first
  std::size_t referenced_frames_ = 0;  // that have references: the first of the subject's
};

}  // namespace herr
