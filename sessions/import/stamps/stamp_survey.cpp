#include "sessions/import/stamps/stamp_survey.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "sessions/files/input_error.h"
#include "sessions/import/stamps/stamp_remarks.h"
#include "sessions/import/stamps/stamp_runs.h"
#include "sessions/import/stamps/step_pattern.h"

namespace herr {
namespace {

constexpr std::size_t kFirstRows = 1000;  // tell the usual step
constexpr std::int64_t kFewestEqual = 3;  // two rows of one stamp may be an accident

// Takes the stamps in the order of the file.
class Surveyor {
 public:
  explicit Surveyor(std::size_t sort_rows) : sort_rows_(sort_rows) {
    first_stamps_.reserve(kFirstRows);
    first_places_.reserve(kFirstRows);
  }

  void add(TimeNs stamp_ns, const RowPlace& place) {
    count(stamp_ns, place);
    if (runs_) {
      runs_->add(stamp_ns, place);
      close_ += step_ns_ > 0 && step_ns_ < pattern_.thin_below_ns ? 1 : 0;
      return;
    }
    first_stamps_.push_back(stamp_ns);
    first_places_.push_back(place);
    if (first_stamps_.size() == kFirstRows) begin_runs();
  }

  StampSurvey result() {
    if (!runs_) begin_runs();
    StampSurvey survey;
    survey.rows = clock_.rows;
    survey.all_equal = clock_.rows >= kFewestEqual && lowest_ns_ == highest_ns_;
    survey.usual_step_ns = pattern_.usual_ns;
    const auto steps = static_cast<double>(clock_.rows - 1);
    if (pattern_.cameras == 0 || static_cast<double>(close_) < kCloseShare * steps) pattern_.cameras = 0;
    if (pattern_.cameras > 0) survey.thin_below_ns = pattern_.thin_below_ns;
    runs_->choose();
    survey.left_out = std::move(runs_->left_out());
    set_span(survey);
    survey.remarks = stamp_remarks(clock_, pattern_, *runs_);
    return survey;
  }

 private:
  void count(TimeNs stamp_ns, const RowPlace& place) {
    step_ns_ = clock_.rows > 0 ? stamp_ns - before_ns_ : 1;
    if (step_ns_ == 0 && clock_.equal++ == 0) {
      clock_.equal_line = place.line;
      clock_.equal_ns = stamp_ns;
    }
    clock_.backward += step_ns_ < 0 ? 1 : 0;
    lowest_ns_ = clock_.rows > 0 ? std::min(lowest_ns_, stamp_ns) : stamp_ns;
    highest_ns_ = clock_.rows > 0 ? std::max(highest_ns_, stamp_ns) : stamp_ns;
    before_ns_ = stamp_ns;
    ++clock_.rows;
  }

  void begin_runs() {
    pattern_ = step_pattern(first_stamps_);
    runs_.emplace(pattern_.usual_ns, sort_rows_);
    for (std::size_t i = 0; i < first_stamps_.size(); ++i) {
      runs_->add(first_stamps_[i], first_places_[i]);
      const TimeNs step_ns = i > 0 ? first_stamps_[i] - first_stamps_[i - 1] : 0;
      close_ += step_ns > 0 && step_ns < pattern_.thin_below_ns ? 1 : 0;
    }
  }

  void set_span(StampSurvey& survey) const {
    survey.lowest_ns = survey.first_ns = lowest_ns_;
    survey.last_ns = highest_ns_;
    bool first = true;
    for (const StampRun& run : runs_->runs()) {
      if (!run.kept) continue;
      if (first) survey.first_ns = run.first_ns;
      survey.lowest_ns = first ? run.lowest_ns : std::min(survey.lowest_ns, run.lowest_ns);
      survey.last_ns = run.highest_ns;
      first = false;
    }
  }

  std::size_t sort_rows_;
  std::vector<TimeNs> first_stamps_;
  std::vector<RowPlace> first_places_;
  StepPattern pattern_;
  std::optional<StampRuns> runs_;
  ClockCounts clock_;
  TimeNs before_ns_ = 0, step_ns_ = 0, lowest_ns_ = 0, highest_ns_ = 0;
  std::int64_t close_ = 0;
};

}  // namespace

StampSurvey survey_stamps(RowSource& rows, TimeReader& time, std::size_t sort_rows, std::int64_t most_rows) {
  Surveyor surveyor(sort_rows);
  RowPlace place;
  std::int64_t carried_line = 0;
  for (std::int64_t row = 0; most_rows == 0 || row < most_rows; ++row) {
    bool whole = false;
    try {
      if (!rows.next()) break;
      whole = true;
      place.move_to(rows.line());
      surveyor.add(time.read(rows), place);
    } catch (const InputError&) {
      if (whole) continue;
      place.move_to(rows.line());
      time.pass_over();
    }
    if (time.carried_ns() > 0 && carried_line == 0) carried_line = place.line;
  }
  StampSurvey survey = surveyor.result();
  if (time.carried_ns() > 0) survey.carried_line = carried_line;
  return survey;
}

}  // namespace herr
