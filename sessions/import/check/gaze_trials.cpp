#include "sessions/import/check/gaze_trials.h"

#include <algorithm>
#include <array>
#include <utility>

#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

constexpr double kAheadDeg = 40;        // people's eyes rest within it
constexpr double kClearEvidence = 8;    // between readings: four standard deviations for each
constexpr double kClearlyNearer = 1.6;  // gaze to the head's forward, in the right space
constexpr double kTurningDeg = 15;      // so much a head has to turn to tell the spaces apart

// Besides the head's own axes: as eye trackers write gaze whatever the head's file does.
constexpr std::array<std::array<const char*, 3>, 3> kTrackerAxes{
    {{"right", "up", "forward"}, {"left", "up", "forward"}, {"right", "up", "back"}}};

void add_axes(const RecordingFiles& files, const AxisCandidate& head, GazeSpace space, GazeTrials& trials) {
  std::vector<AxisDirections> all{space == GazeSpace::world ? head.map->head.front().world_axes
                                                            : head.map->head.front().head_axes};
  if (space != GazeSpace::world)
    for (const auto& words : kTrackerAxes)
      if (std::find(all.begin(), all.end(), directions(words)) == all.end()) all.push_back(directions(words));
  for (const AxisDirections& axes : all) {
    ColumnMap map = *head.map;
    map.gaze.front().space = space;
    map.gaze.front().axes = axes;
    AxisCandidate one = tried(files, std::move(map), head.reading, head.convention, true);
    one.against = implausible(one.trial);
    if (one.against.empty() && one.figures().median_gaze_deg > kAheadDeg)
      one.against =
          "the eyes rest " + fixed_text(one.figures().median_gaze_deg, 0) + " degrees off the head's forward";
    trials.candidates.push_back(std::move(one));
  }
}

bool is_world(const AxisCandidate& one) {
  return one.map->gaze.front().space == GazeSpace::world;
}

// The space in which the eyes rest clearly nearer to the head's forward; countering cannot tell, as gaze that
// is taken for the world's seems to counter all the head does.
void tell_space(GazeTrials& trials) {
  double world = 1e9, local = 1e9, turns = 0;
  for (const AxisCandidate& one : trials.candidates) {
    if (one.trial.error) continue;
    double& nearest = is_world(one) ? world : local;
    nearest = std::min(nearest, one.figures().median_gaze_deg);
    turns = std::max(turns, one.figures().forward_spread_deg);
  }
  const bool of_world = world * kClearlyNearer < local, of_head = local * kClearlyNearer < world;
  if (turns < kTurningDeg || (!of_world && !of_head)) {
    trials.questions.push_back(
        "Whether the gaze is in the head's axes or in the world's: the head turns too little to tell "
        "(\"space\" of the "
        "gaze in the map).");
    return;
  }
  trials.reasons.push_back(std::string("The gaze is in the ") + (of_world ? "world's" : "head's") +
                           " axes: so read it lies " + fixed_text(std::min(world, local), 0) +
                           " degrees off the head's forward in the median, else " +
                           fixed_text(std::max(world, local), 0) + ".");
  for (AxisCandidate& one : trials.candidates)
    if (is_world(one) != of_world) one.against = "the gaze is in the other space";
}

double evidence_of(const AxisCandidate& one) {
  return eye_evidence(one.trial);
}

void exclude_by_countering(GazeTrials& trials) {
  const AxisCandidate* best = nullptr;
  for (const AxisCandidate& one : trials.candidates)
    if (one.against.empty() && (!best || evidence_of(one) > evidence_of(*best))) best = &one;
  if (!best) return;
  const double most = evidence_of(*best);
  for (AxisCandidate& one : trials.candidates) {
    if (!one.against.empty() || most - evidence_of(one) <= kClearEvidence) continue;
    one.against = "the eyes do not counter the head";
    trials.eyes_tell = true;
  }
  if (trials.eyes_tell)
    trials.reasons.push_back("The eyes turn against the head as people's do, " + fixed_text(most, 1) +
                             " standard deviations from chance; with other axes they turn with it.");
}

std::string axes_text(const AxisDirections& axes) {
  const auto words = axes.words();
  return "(" + words[0] + ", " + words[1] + ", " + words[2] + ")";
}

}  // namespace

GazeTrials try_gaze(const RecordingFiles& files, const std::vector<const AxisCandidate*>& heads,
                    const std::vector<AxisReading>& readings) {
  GazeTrials trials;
  bool open_space = false;
  for (const AxisCandidate* head : heads) {
    const auto& space = readings[head->reading].space;
    open_space = open_space || !space;
    for (const GazeSpace one : {GazeSpace::head, GazeSpace::world})
      if (!space || *space == one) add_axes(files, *head, one, trials);
  }
  if (open_space) tell_space(trials);
  exclude_by_countering(trials);
  const std::vector<const AxisCandidate*> left = remaining(trials.candidates);
  if (left.empty()) {
    trials.questions.push_back(
        "In which axes the gaze is: with none of the usual ones the eyes rest ahead of the head "
        "(\"axes\" of the gaze in the map).");
  } else if (left.size() == 1) {
    trials.reasons.push_back("The gaze's x, y and z point " +
                             axes_text(left.front()->map->gaze.front().axes) + ": so read the eyes rest " +
                             fixed_text(left.front()->figures().median_gaze_deg, 0) +
                             " degrees off the head's forward in the median.");
  }
  return trials;
}

}  // namespace herr
