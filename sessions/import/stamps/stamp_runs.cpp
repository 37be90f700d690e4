#include "sessions/import/stamps/stamp_runs.h"

#include <algorithm>

namespace herr {
namespace {

constexpr double kNearSteps = 4;    // so far from the newest stamp, a stamp belongs to the same run
constexpr double kFarSteps = 1000;  // and so far ahead, or ...
constexpr double kFarNs = 10e9;     // ... so much, the recording paused, or the stamp is wild
// A clock that jumps and comes back after at most so many rows was wrong in between.
constexpr std::int64_t kGlitchRows = 100;
constexpr std::size_t kGlitchRuns = 3;   // jumps of those that are settled while reading
constexpr double kReturnSteps = 64;      // to where the clock would have been without the jump
constexpr double kLateSteps = 64;        // rows that come at most so late are in disorder
constexpr std::int64_t kLoneShare = 10;  // rows of the longest run for each row of a lone one

}  // namespace

StampRuns::StampRuns(double usual_step_ns, std::size_t sort_rows)
    : usual_step_ns_(usual_step_ns),
      near_ns_(static_cast<TimeNs>(
          std::min(std::max(kNearSteps, static_cast<double>(sort_rows)) * usual_step_ns, 1e18))),
      far_ns_(static_cast<TimeNs>(std::min(std::max(kFarSteps * usual_step_ns, kFarNs), 8e18))) {}

void StampRuns::add(TimeNs stamp_ns, const RowPlace& place) {
  if (too_many_) return;
  if (!runs_.empty()) {
    StampRun& run = runs_.back();
    const TimeNs step_ns = stamp_ns - run.highest_ns;
    if (step_ns >= -near_ns_ && step_ns <= near_ns_) {
      extend(run, stamp_ns, place);
      return;
    }
  }
  jump(stamp_ns, place);
}

void StampRuns::extend(StampRun& run, TimeNs stamp_ns, const RowPlace& place) const {
  ++run.rows;
  run.last = place;
  run.lowest_ns = std::min(run.lowest_ns, stamp_ns);
  run.highest_ns = std::max(run.highest_ns, stamp_ns);
}

void StampRuns::jump(TimeNs stamp_ns, const RowPlace& place) {
  if (returns(stamp_ns, place)) return;
  if (runs_.size() == kMost) merge_hitches();
  if (runs_.size() >= kMost || left_out_.size() >= kMostLeftOut) {
    too_many_ = true;
    runs_.clear();
    left_out_.clear();
    return;
  }
  StampRun run;
  if (!runs_.empty()) {
    const TimeNs newest_ns = runs_.back().highest_ns;
    run.start = stamp_ns < newest_ns       ? StampRun::Start::back
                : far(newest_ns, stamp_ns) ? StampRun::Start::far_ahead
                                           : StampRun::Start::ahead;
  }
  run.first = place;
  run.first_ns = run.lowest_ns = run.highest_ns = stamp_ns;
  extend(run, stamp_ns, place);
  runs_.push_back(run);
}

// The stamp goes on where a run before the last few rows ended: those few are left out.
bool StampRuns::returns(TimeNs stamp_ns, const RowPlace& place) {
  std::int64_t between = 0;
  bool back = !runs_.empty() && stamp_ns < runs_.back().highest_ns;
  for (std::size_t k = 1; k <= kGlitchRuns && k < runs_.size(); ++k) {
    const StampRun& glitch = runs_[runs_.size() - k];
    back = back || glitch.start == StampRun::Start::back;
    between += glitch.rows;
    if (between > kWildRows) return false;
    StampRun& before = runs_[runs_.size() - k - 1];
    if (between > before.rows) continue;
    const TimeNs step_ns = stamp_ns - before.highest_ns;
    const double most_ns = (static_cast<double>(between) + kReturnSteps) * usual_step_ns_;
    if (!back || step_ns < -near_ns_ || static_cast<double>(step_ns) > most_ns) continue;
    for (std::size_t i = runs_.size() - k; i < runs_.size(); ++i) {
      const bool late =
          runs_[i].highest_ns < before.highest_ns &&
          static_cast<double>(before.highest_ns - runs_[i].lowest_ns) <= kLateSteps * usual_step_ns_;
      left_out_.push_back(
          {runs_[i].first, runs_[i].last, late ? RowFate::backward_stamp : RowFate::wild_stamp});
    }
    extend(before, stamp_ns, place);
    runs_.resize(runs_.size() - k);
    return true;
  }
  return false;
}

// Runs that are only some steps apart are one run with a hitch, unless one of them may be a glitch: some rows
// before a step back, or behind one and with the clock as it was before behind them.
void StampRuns::merge_hitches() {
  std::vector<StampRun> merged;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const StampRun& run = runs_[i];
    bool merge = !merged.empty() && run.start == StampRun::Start::ahead;
    if (i + 1 < runs_.size() && runs_[i + 1].start == StampRun::Start::back) merge &= run.rows > kGlitchRows;
    if (merge && merged.size() > 1 && merged.back().start == StampRun::Start::back)
      merge =
          merged.back().rows > kGlitchRows || run.first_ns < merged[merged.size() - 2].highest_ns - near_ns_;
    if (!merge) {
      merged.push_back(run);
      continue;
    }
    StampRun& before = merged.back();
    before.rows += run.rows;
    before.last = run.last;
    before.highest_ns = run.highest_ns;
  }
  runs_ = std::move(merged);
}

void StampRuns::choose() {
  if (too_many_ || runs_.empty()) return;
  merge_hitches();
  choose_chain();
  drop_lone_rows();
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const StampRun& run = runs_[i];
    if (run.kept) continue;
    const bool between = i > 0 && i + 1 < runs_.size() && runs_[i - 1].kept && runs_[i + 1].kept;
    const bool wild = run.rows <= (between ? kGlitchRows : kWildRows);
    left_out_.push_back({run.first, run.last, wild ? RowFate::wild_stamp : RowFate::other_clock});
  }
  std::sort(left_out_.begin(), left_out_.end(),
            [](const LeftOutRows& a, const LeftOutRows& b) { return a.first < b.first; });
}

void StampRuns::choose_chain() {
  std::vector<std::int64_t> rows(runs_.size());
  std::vector<std::size_t> before(runs_.size());
  std::size_t best = 0;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    before[i] = i;  // none
    for (std::size_t j = 0; j < i; ++j)
      if (runs_[i].lowest_ns > runs_[j].highest_ns && rows[j] > (before[i] == i ? 0 : rows[before[i]]))
        before[i] = j;
    rows[i] = runs_[i].rows + (before[i] == i ? 0 : rows[before[i]]);
    if (rows[i] > rows[best]) best = i;
  }
  for (std::size_t i = best;; i = before[i]) {
    runs_[i].kept = true;
    if (before[i] == i) break;
  }
}

// A few rows far from everything else are wild, though they would fit in.
void StampRuns::drop_lone_rows() {
  std::vector<StampRun*> chain;
  std::int64_t longest = 0;
  for (StampRun& run : runs_) {
    if (!run.kept) continue;
    chain.push_back(&run);
    longest = std::max(longest, run.rows);
  }
  for (std::size_t i = 0; i < chain.size(); ++i) {
    StampRun& run = *chain[i];
    const bool lone = (i == 0 || far(chain[i - 1]->highest_ns, run.lowest_ns)) &&
                      (i + 1 == chain.size() || far(run.highest_ns, chain[i + 1]->lowest_ns));
    if (lone && run.rows <= kWildRows && longest >= kLoneShare * run.rows && chain.size() > 1)
      run.kept = false;
  }
}

}  // namespace herr
