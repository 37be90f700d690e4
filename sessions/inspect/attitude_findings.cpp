#include "sessions/inspect/attitude_findings.h"

#include <string>

#include "sessions/inspect/plausibility.h"
#include "sessions/inspect/plausibility_words.h"
#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

constexpr double kMostOfTheRows = 0.5;
// People look down at what they do for minutes, but hardly ever up for half of the time.
constexpr double kHighestLookDeg = 40;
constexpr double kWalksBackwards = 0.2, kLongWayM = 5;

const std::string kCorrectAxes =
    "convert again with another --variant, or with --map: the map of --show-map, its head_axes or world_axes "
    "corrected";

}  // namespace

void judge_attitude(const AttitudeMeter& head, const std::filesystem::path& file, FindingList& findings) {
  if (head.rows() < PlausibilityMeter::kFewestRows) return;
  const bool skyward = head.median_pitch_deg() > kHighestLookDeg;
  if (head.level_share() < kMostOfTheRows || skyward) {
    const bool looks_away =
        skyward || head.looks_up_share() >= kMostOfTheRows || head.looks_down_share() >= kMostOfTheRows;
    const std::string what =
        looks_away ? "the head looks " + where_it_looks(head)
        : head.upside_share() >= kMostOfTheRows || head.side_share() >= kMostOfTheRows
            ? "the head is " + which_way_is_up(head)
            : "the head is upright in " + percents(head.level_share()) + " of the rows only";
    findings.add(Severity::warning, InputError(file, 0, what + "; " + likely_wrong_axis(head), kCorrectAxes));
  }
  const double forwards_m = head.way_forwards_m(), backwards_m = head.way_backwards_m();
  if (forwards_m + backwards_m >= kLongWayM && forwards_m < kWalksBackwards * (forwards_m + backwards_m))
    findings.add(
        Severity::note,
        InputError(file, 0,
                   "the head goes backwards over " + percents(backwards_m / (forwards_m + backwards_m)) +
                       " of " + fixed_text(forwards_m + backwards_m, 1) + " m of way",
                   "if nobody walked backwards, forward and back are exchanged, or the handedness is wrong"));
}

}  // namespace herr
