#include "sessions/import/presets/trial_import.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "sessions/inspect/plausibility_words.h"
#include "sessions/inspect/stream_summary.h"
#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

// More than this share of the rows against it: the axes are wrong. People lie down and trackers fail, but not
// for most of a recording.
constexpr double kMost = 0.5;
// Noise of trackers makes eyes diverge in up to half of the rows; mirrored ones diverge in nearly all.
constexpr double kNearlyAll = 0.9;

// Under the true axes the head's up is steadier than its sides: by so much it is told from chance.
constexpr double kSteadierTimes = 1.5, kSteadierByDeg = 1;
constexpr double kLevel = 0.7;  // of the rows

class RowsHash {
 public:
  void add(std::int64_t value) { add_bits(static_cast<std::uint64_t>(value)); }
  void add(const glm::dvec3& v) {
    for (const double value : {v.x, v.y, v.z}) add_bits(std::bit_cast<std::uint64_t>(value + 0.0));
  }
  void add(const PoseRow& row) {
    const Pose& pose = row.world_from_head;
    add(row.stamp_ns);
    add(pose.position);
    add(pose.orientation * glm::dvec3(1, 0, 0));
    add(pose.orientation * glm::dvec3(0, 1, 0));
  }
  void add(const GazeRow& row) {
    add(row.stamp_ns);
    for (std::size_t eye = 0; eye < 2; ++eye)
      if (row.valid[eye]) add(row.head_direction[eye]);
  }
  std::uint64_t value() const { return hash_; }

 private:
  void add_bits(std::uint64_t bits) {
    hash_ ^= bits + 0x9e3779b97f4a7c15u + (hash_ << 6) + (hash_ >> 2);
    hash_ *= 0xff51afd7ed558ccdu;
  }
  std::uint64_t hash_ = 0;
};

// Lost tracking says nothing against the columns.
double unusable_share(const ImportedStream& stream) {
  if (stream.rows_read == 0) return 0;
  const auto untracked = static_cast<double>(stream.lost(RowFate::lost_tracking));
  return stream.lost_share() - untracked / static_cast<double>(stream.rows_read);
}

std::string share_words(double share) {
  return percents(share) + " of the rows";
}

}  // namespace

TrialImport trial_import(ImportRequest request, std::int64_t most_rows) {
  request.keep_going = true;
  request.most_rows = most_rows;
  TrialImport trial;
  PlausibilityMeter meter;
  RowsHash hash;
  double heights_m = 0;
  const bool per_eye = request.columns.gaze != nullptr && request.columns.gaze->rays.size() > 1;
  try {
    const ImportReport report = import_rows(request, {[&](const PoseRow& row) {
                                                        meter.add(row);
                                                        hash.add(row);
                                                        heights_m += row.world_from_head.position.y;
                                                      },
                                                      [&](const GazeRow& row) {
                                                        meter.add(row, per_eye);
                                                        hash.add(row);
                                                      }});
    trial.unusable_share = std::max(unusable_share(report.poses), unusable_share(report.gaze));
    trial.rarity = rarity(report.poses.intervals);
    trial.remarks = report.poses.remarks;
    trial.remarks.insert(trial.remarks.end(), report.remarks.begin(), report.remarks.end());
    trial.pose_hz = report.poses.rate_hz();
    trial.gaze_hz = report.has_gaze ? report.gaze.rate_hz() : 0;
  } catch (const InputError& error) {
    trial.error = error;
    return trial;
  }
  trial.figures = meter.figures();
  trial.mean_height_m = heights_m / static_cast<double>(std::max<std::int64_t>(1, trial.figures.pose_rows));
  trial.words = meter.words();
  trial.gaze_words = meter.gaze_words();
  trial.rows_hash = hash.value();
  return trial;
}

std::string implausible(const TrialImport& trial) {
  const PlausibilityFigures& f = trial.figures;
  if (trial.error) return "its rows cannot be read";
  if (!trial.rarity.empty()) return trial.rarity;
  if (f.fast_share && *f.fast_share > kMost)
    return "the head goes faster than 10 m/s in " + share_words(*f.fast_share) + " (another unit?)";
  if (trial.unusable_share > kMost) return share_words(trial.unusable_share) + " cannot be used";
  if (f.level_share && *f.level_share < kMost)
    return "the head is not level in " + share_words(1 - *f.level_share);
  if (f.diverging_share && *f.diverging_share > kNearlyAll)
    return "the eyes diverge in " + share_words(*f.diverging_share);
  if (f.off_axis_share && *f.off_axis_share > kMost)
    return "the gaze is more than 60 degrees off the head's forward in " + share_words(*f.off_axis_share);
  return "";
}

std::string better_because(const TrialImport& a, const TrialImport& b) {
  const PlausibilityFigures &x = a.figures, &y = b.figures;
  if (x.level_share && y.level_share && *x.level_share >= kLevel && x.head_turns &&
      y.up_spread_deg > kSteadierTimes * x.up_spread_deg + kSteadierByDeg)
    return "the head's up wavers by " + fixed_text(y.up_spread_deg, 1) + " degrees instead of " +
           fixed_text(x.up_spread_deg, 1);
  const double more = eye_evidence(a) - eye_evidence(b);
  if (more > kChanceEvidence)
    return "the eyes counter the turns of the head less, by " + fixed_text(more, 1) + " standard deviations";
  return "";
}

double eye_evidence(const TrialImport& trial) {
  return trial.figures.evidence_x + trial.figures.evidence_y;
}

}  // namespace herr
