#include "sessions/inspect/stream_summary.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sessions/inspect/number_words.h"
#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

constexpr std::size_t kGapsShown = 4;
// Two samples lost and more than a frame of a 60 Hz display: one sees it.
constexpr double kVisibleGapIntervals = 2.5;
constexpr TimeNs kVisibleGapNs = 25'000'000;
constexpr double kRarestS = 2;  // rows further apart tell of no head
constexpr std::int64_t kFewestJudgedRows = 20;
constexpr double kManyRepeats = 0.05;    // fewer are a head at rest
constexpr double kRateTolerance = 0.02;  // of the nominal rate
constexpr TimeNs kClockSlackNs = 1'000'000'000;
// Two streams drift by tens of ppm; a change of more intervals is a late start or an early end.
constexpr double kMostDriftPpm = 1000;

// `poses`: of the same recording. A log that writes gaze with each pose has its gaps
// twice; they are told once.
void judge_gaps(const StreamSummary& poses, const StreamSummary& stream, FindingList& findings) {
  const std::vector<StreamGap> gaps = stream.longest_gaps();
  const bool the_same = &poses != &stream && gaps == poses.longest_gaps() &&
                        stream.intervals.hitches() == poses.intervals.hitches();
  if (gaps.empty() || the_same) return;
  const TimeNs start_ns = poses.rows > 0 ? poses.first_ns : stream.first_ns;
  const double median_ns = stream.intervals.median_ns();
  const auto widest_ns = static_cast<double>(gaps.front().length_ns);
  const bool visible = widest_ns > kVisibleGapIntervals * median_ns && gaps.front().length_ns > kVisibleGapNs;
  const auto at_s = [&](const StreamGap& gap) {
    return fixed_text(static_cast<double>(gap.end_ns - start_ns) * kSecondsPerNs, 2) + " s";
  };
  Finding finding{
      visible ? Severity::warning : Severity::note,
      InputError(stream.file, gaps.front().end_line,
                 "a gap of " + milliseconds(gaps.front().length_ns) + " (" +
                     fixed_text(widest_ns / median_ns, 1) + " intervals of " +
                     milliseconds(std::llround(median_ns)) + ") ends here, at " + at_s(gaps.front()),
                 "the last sample is held across a gap"),
      false, stream.intervals.hitches()};
  for (std::size_t i = 1; i < std::min(gaps.size(), kGapsShown + 1); ++i)
    finding.others.push_back(milliseconds(gaps[i].length_ns) + " at line " +
                             std::to_string(gaps[i].end_line) + " (" + at_s(gaps[i]) + ")");
  findings.add(std::move(finding));
}

double fresh_hz(const StreamSummary& stream) {
  return static_cast<double>(stream.rows - 1 - stream.repeated_values) / stream.span_s();
}

}  // namespace

void StreamSummary::count(TimeNs stamp_ns, std::int64_t line, bool repeats) {
  if (rows++ == 0) {
    first_ns = last_ns = stamp_ns;
    return;
  }
  const TimeNs interval_ns = stamp_ns - last_ns;
  last_ns = stamp_ns;
  repeated_values += repeats ? 1 : 0;
  intervals.count(interval_ns, line);
  if (longest_.size() == kMostGaps && interval_ns <= longest_.back().length_ns) return;
  if (longest_.size() == kMostGaps) longest_.pop_back();
  const auto place = std::upper_bound(longest_.begin(), longest_.end(), interval_ns,
                                      [](TimeNs length, const StreamGap& g) { return length > g.length_ns; });
  longest_.insert(place, {interval_ns, stamp_ns, line});
}

double StreamSummary::median_hz() const {
  return intervals.median_ns() > 0 ? 1e9 / intervals.median_ns() : 0;
}

double StreamSummary::mean_hz() const {
  return rows > 1 ? static_cast<double>(rows - 1) / span_s() : 0;
}

std::vector<StreamGap> StreamSummary::longest_gaps() const {
  std::vector<StreamGap> gaps = longest_;
  const double limit_ns = kHitchIntervals * intervals.median_ns();
  std::erase_if(gaps, [&](const StreamGap& gap) { return static_cast<double>(gap.length_ns) <= limit_ns; });
  return gaps;
}

std::string rarity(const IntervalCensus& intervals) {
  if (intervals.intervals() < kFewestJudgedRows) return "";
  const double every_s = intervals.median_ns() * kSecondsPerNs;
  if (every_s <= kRarestS) return "";
  return "a row comes every " + fixed_text(every_s, 1) + " s in the median: is the unit of time another?";
}

void judge_stream(const StreamSummary& poses, const StreamSummary& stream, FindingList& findings) {
  if (const std::string rare = &poses == &stream ? rarity(stream.intervals) : ""; !rare.empty())
    findings.add(Severity::warning, InputError(stream.file, 0, rare, "convert it again with the right unit"));
  judge_gaps(poses, stream, findings);
  const double share =
      stream.rows > 1 ? static_cast<double>(stream.repeated_values) / static_cast<double>(stream.rows - 1)
                      : 0;
  if (share > kManyRepeats && !(share == 1 && stream.stillness_told))
    findings.add(Severity::note,
                 InputError(stream.file, 0,
                            percentage(stream.repeated_values, stream.rows - 1) +
                                " of the rows say the same as the row before: about " +
                                fixed_text(fresh_hz(stream), 1) + " new ones a second in " +
                                fixed_text(stream.mean_hz(), 1) + " rows a second",
                            "its sensor is slower than its rows: ages are larger than they seem"));
  const double off =
      stream.nominal_hz > 0 && stream.median_hz() > 0 ? stream.median_hz() / stream.nominal_hz - 1 : 0;
  if (std::abs(off) > kRateTolerance)
    findings.add(Severity::warning,
                 InputError(stream.file, 0,
                            "runs at " + fixed_text(stream.median_hz(), 2) + " Hz where session.json says " +
                                fixed_text(stream.nominal_hz, 2) + " Hz",
                            "correct the rate there, or look for lost rows"));
}

StreamOffset offset_to(const StreamSummary& poses, const StreamSummary& stream) {
  StreamOffset offset;
  offset.start_ns = stream.first_ns - poses.first_ns;
  offset.end_ns = stream.last_ns - poses.last_ns;
  offset.change_ns = offset.end_ns - offset.start_ns;
  offset.resolution_ns = std::llround(poses.intervals.median_ns() + stream.intervals.median_ns());
  if (std::abs(offset.change_ns) <= offset.resolution_ns || poses.span_s() <= 0) return offset;
  const double ppm = static_cast<double>(offset.change_ns) * 1e-3 / poses.span_s();
  if (std::abs(ppm) <= kMostDriftPpm) offset.drift_ppm = ppm;
  return offset;
}

void judge_offset(const StreamSummary& poses, const StreamSummary& stream, FindingList& findings) {
  const StreamOffset offset = offset_to(poses, stream);
  if (offset.start_ns > kClockSlackNs)
    findings.add(Severity::warning,
                 InputError(stream.file, 0, "starts " + milliseconds(offset.start_ns) + " after the poses",
                            "until then there is nothing of this stream; cut the poses, or leave it so"));
  if (offset.end_ns < -kClockSlackNs)
    findings.add(Severity::warning,
                 InputError(stream.file, 0, "ends " + milliseconds(-offset.end_ns) + " before the poses",
                            "its last sample is held until then; cut the poses, or leave it so"));
  if (offset.drift_ppm)
    findings.add(Severity::note,
                 InputError(stream.file, 0,
                            "moved by " + milliseconds(offset.change_ns) + " against the poses, " +
                                fixed_text(*offset.drift_ppm, 0) + " ppm of their time",
                            "if both were started and stopped together, their clocks drift apart"));
}

}  // namespace herr
