// People whose heads and eyes move as people's do raise no warning, and every fault that is made of them
// does.
#include "sessions/inspect/plausibility.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "tests/sessions/inspect/made_person.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using namespace test;

const glm::dvec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

struct Fault {
  const char* name;
  std::function<void(MadeRecording&)> make;
  const char* finding;  // part of it
};

const std::vector<Fault>& faults() {
  static const std::vector<Fault> kFaults{
      // A head that looks level about a world whose z is up lies on its side or looks up.
      {"the world's z is up", [](MadeRecording& r) { turn_world(r, rows(kX, kZ, -kY)); }, "the head "},
      {"the head's z is up", [](MadeRecording& r) { turn_head(r, rows(kX, kZ, -kY)); }, "looks straight up"},
      {"the head's -z is up", [](MadeRecording& r) { turn_head(r, rows(kX, -kZ, kY)); },
       "looks straight down"},
      {"the head's x is up", [](MadeRecording& r) { turn_head(r, rows(-kY, kX, kZ)); }, "on its side"},
      {"upside down", [](MadeRecording& r) { turn_head(r, rows(-kX, -kY, kZ)); }, "upside down"},
      {"gaze mirrored in x", [](MadeRecording& r) { turn_gaze(r, rows(-kX, kY, kZ)); },
       "turns sideways, the eyes turn with it"},
      {"gaze mirrored in x: vergence", [](MadeRecording& r) { turn_gaze(r, rows(-kX, kY, kZ)); },
       "the eyes diverge"},
      {"gaze mirrored in y", [](MadeRecording& r) { turn_gaze(r, rows(kX, -kY, kZ)); },
       "turns up and down, the eyes turn with it"},
      {"gaze mirrored in both", [](MadeRecording& r) { turn_gaze(r, rows(-kX, -kY, kZ)); },
       "the eyes turn with it"},
      {"gaze's z turned round", [](MadeRecording& r) { turn_gaze(r, rows(kX, kY, -kZ)); },
       "off the head's axis in 100 %"},
      {"gaze's axes exchanged", [](MadeRecording& r) { turn_gaze(r, rows(kY, kX, kZ)); },
       "sideways, the eyes turn up or down"},
      {"head mirrored",
       [](MadeRecording& r) {
         for (PoseRow& row : r.poses) {
           glm::dquat& q = row.world_from_head.orientation;
           q = glm::dquat(q.w, q.x, -q.y, -q.z);
         }
       },
       "turns sideways, the eyes turn with it"},
      {"head stands still",
       [](MadeRecording& r) {
         for (PoseRow& row : r.poses) row.world_from_head = r.poses[0].world_from_head;
       },
       "the head stands still to the last digit"},
      {"orientation stands still",
       [](MadeRecording& r) {
         for (PoseRow& row : r.poses) row.world_from_head.orientation = glm::dquat(1, 0, 0, 0);
       },
       "its orientation stands still"},
      {"position in millimetres",
       [](MadeRecording& r) {
         for (PoseRow& row : r.poses) row.world_from_head.position *= 1000;
       },
       "the head goes faster than 10 m/s"},
      {"position stands still",
       [](MadeRecording& r) {
         for (PoseRow& row : r.poses) row.world_from_head.position = {0, 1.6, 0};
       },
       "its position stands still"},
      {"gaze never changes",
       [](MadeRecording& r) {
         for (GazeRow& row : r.gaze) row.head_direction = r.gaze[0].head_direction;
       },
       "the gaze never changes"},
      {"gaze rests in the head",
       [](MadeRecording& r) {
         for (GazeRow& row : r.gaze)
           row.head_direction[0] = row.head_direction[1] =
               glm::normalize(glm::dvec3(1e-9 * static_cast<double>(row.stamp_ns % 7), 0, -1));
       },
       "the eyes rest in the head"},
      {"both eyes hold one ray",
       [](MadeRecording& r) {
         for (GazeRow& row : r.gaze) row.head_direction[1] = row.head_direction[0];
       },
       "both eyes hold the same ray in 100 %"},
      {"left and right exchanged",
       [](MadeRecording& r) {
         for (GazeRow& row : r.gaze) std::swap(row.head_direction[0], row.head_direction[1]);
       },
       "the eyes diverge"},
      {"poses joined by lines", join_every_third_pose, "straight lines between samples at about 30"},
      {"gaze smoothed", smooth_gaze, "do not stop abruptly"}};
  return kFaults;
}

TEST(Plausibility, FindsNothingWrongWithPeopleHoweverLongTheyAreRecorded) {
  for (const double seconds : {0.5, 1.0, 2.0, 5.0, 30.0})
    for (std::uint32_t seed = 1; seed <= 12; ++seed)
      EXPECT_EQ(judged(made_person(seed, seconds)), "") << "seed " << seed << ", " << seconds << " s";
}

TEST(Plausibility, FindsEveryFaultThatIsMadeOfGoodRecordings) {
  for (const Fault& fault : faults())
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
      MadeRecording recording = made_person(seed, 20);
      fault.make(recording);
      EXPECT_PRED2(holds, judged(recording), fault.finding) << fault.name << ", seed " << seed;
    }
}

TEST(Plausibility, SaysWhichAxisSeemsWrong) {
  // Reading z-up numbers as y-up turns the head's steady up to -z: rows (x, z, -y) map (0, 1, 0) to (0, 0,
  // -1).
  MadeRecording world = made_person(1, 20);
  turn_world(world, rows(kX, kZ, -kY));
  EXPECT_PRED2(holds, judged(world), "its up is steady, but along the world's forward (-z): world axes?");
  // rows (x, z, -y) take the true up, +y of the head, for its -z, which is forward.
  MadeRecording head = made_person(1, 20);
  turn_head(head, rows(kX, kZ, -kY));
  EXPECT_PRED2(holds, judged(head), "the head's forward is what points up: head axes?");
}

TEST(Plausibility, SaysWhereTheHeadLooksAndHowLevelItIs) {
  // Yaw 40, pitch -30, roll 10 degrees: up.y = cos 30 cos 10 = 0.85287, a tilt of 31.47 degrees.
  MadeRecording recording;
  const glm::dquat turn = glm::angleAxis(glm::radians(40.0), kY) * glm::angleAxis(glm::radians(-30.0), kX) *
                          glm::angleAxis(glm::radians(10.0), kZ);
  for (int i = 0; i < 50; ++i) recording.poses.push_back({i * 10'000'000LL, {{0, 1, 0.1 * i}, turn}});
  const PlausibilityFigures figures = measured(recording).figures();
  EXPECT_EQ(figures.level_share, 1.0);
  EXPECT_NEAR(figures.median_tilt_deg, 31.47, 0.25);
  EXPECT_NEAR(figures.median_roll_deg, 10, 0.26);
  EXPECT_NEAR(figures.median_pitch_deg, -30, 0.26);
  EXPECT_FALSE(figures.head_turns);
  EXPECT_TRUE(figures.head_moves);
  EXPECT_EQ(measured(recording).words(),
            "the head looks 30 degrees down (in the median); it is upright in 100 % of the rows (31 degrees "
            "of tilt and "
            "10 of roll in the median)");
}

TEST(Plausibility, KnowsTheSteadyAxisOfAHeadThatTurnsAllTheWayRound) {
  // 360 degrees of yaw: right and forward cancel out, a root mean square chord of sqrt(2) rad = 81.03
  // degrees.
  MadeRecording recording;
  for (int i = 0; i < 360; ++i)
    recording.poses.push_back({i * 10'000'000LL, {{0, 1, 0}, glm::angleAxis(glm::radians(1.0 * i), kY)}});
  const PlausibilityFigures figures = measured(recording).figures();
  EXPECT_NEAR(figures.up_spread_deg, 0, 1e-5);
  EXPECT_NEAR(figures.right_spread_deg, 81.03, 0.01);
  EXPECT_NEAR(figures.forward_spread_deg, 81.03, 0.01);
  EXPECT_NEAR(figures.mean_up.y, 1, 1e-9);
}

TEST(Plausibility, KnowsNothingOfAHandfulOfRows) {
  MadeRecording recording = made_person(1, 0.2);  // 18 poses
  turn_head(recording, rows(-kX, -kY, kZ));
  turn_gaze(recording, rows(-kX, kY, kZ));
  recording.gaze.resize(19);
  const PlausibilityFigures figures = measured(recording).figures();
  EXPECT_FALSE(figures.level_share || figures.diverging_share || figures.off_axis_share ||
               figures.countering_x);
  EXPECT_EQ(judged(recording), "");
}

TEST(Plausibility, PrefersTheTrueAxesOfTheGazeInTwoHundredRows) {
  // 2.5 s of 90 Hz. What is read by the true axes has more evidence than any other reading, sideways and
  // vertically.
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const MadeRecording right = made_person(seed, 2.5);
    MadeRecording mirrored = right;
    turn_gaze(mirrored, rows(-kX, kY, kZ));
    const PlausibilityFigures a = measured(right).figures(), b = measured(mirrored).figures();
    EXPECT_GT(a.evidence_x, 2) << seed;
    EXPECT_LT(b.evidence_x, -2) << seed;
    EXPECT_GT(a.evidence_x + a.evidence_y, b.evidence_x + b.evidence_y) << seed;
    EXPECT_GT(*a.countering_x, 0.5) << seed;
  }
}

TEST(Plausibility, TakesAnOrientationAndItsNegativeForOne) {
  MadeRecording recording = made_person(1, 2);
  for (std::size_t i = 0; i < recording.poses.size(); ++i)
    recording.poses[i].world_from_head = {
        {0, 1, 0}, i % 2 == 0 ? glm::dquat(0.8, 0, 0.6, 0) : glm::dquat(-0.8, 0, -0.6, 0)};
  EXPECT_PRED2(holds, judged(recording), "the head stands still to the last digit in all 180 rows");
}

TEST(Plausibility, IsSilentAboutStillnessThatWasMeant) {
  MadeRecording recording = made_person(1, 2);
  for (PoseRow& row : recording.poses) row.world_from_head = Pose{};
  for (GazeRow& row : recording.gaze) row.head_direction = recording.gaze[0].head_direction;
  PlausibilityMeter meter = measured(recording);
  FindingList told, untold;
  meter.judge("p", "g", told);
  EXPECT_EQ(told.count(Severity::warning), 2);
  meter.expect_still_head();
  meter.expect_still_gaze();
  meter.judge("p", "g", untold);
  EXPECT_TRUE(untold.sorted().empty());
}

TEST(Plausibility, NotesAWayThatIsWalkedBackwards) {
  // 1 m/s along +z for 10 s; the head looks along -z. Steps of 0.1 s: 99 whole ones in 899 intervals of 11.1
  // ms.
  MadeRecording recording;
  for (int i = 0; i < 900; ++i)
    recording.poses.push_back(
        {std::llround(i * 1e9 / 90), {{0, 1.6, i / 90.0}, glm::angleAxis(0.1 * std::sin(i * 0.01), kY)}});
  EXPECT_PRED2(holds, judged(recording), "note: the head goes backwards over 100 % of 9.9 m");
  EXPECT_EQ(measured(recording).figures().forwards_share, 0.0);
}

TEST(GazeCountering, KeepsAFewMegabytesOfHoursAndStillKnowsTheEyes) {
  // Every second pose of 90 Hz in three hours is 486,000 of them, 24 bytes each or a little more.
  const MadeRecording minute = made_person(3, 60);
  GazeCountering countering;
  const auto repeated = [&](const auto& rows) {
    for (int round = 0; round < 180; ++round)
      for (auto row : rows) {
        row.stamp_ns += round * 60'000'000'000;
        countering.add(row);
      }
  };
  repeated(minute.poses);
  EXPECT_LE(countering.bytes(), 4u << 20);
  repeated(minute.gaze);
  // They fit after three halvings, to an eighth: of 10,800 s 1350 s, with 40 windows each.
  EXPECT_NEAR(static_cast<double>(countering.horizontal().votes), 1350 * 40, 1350 * 40 * 0.25);
  EXPECT_GT(static_cast<double>(countering.horizontal().against),
            0.7 * static_cast<double>(countering.horizontal().telling()));
}

TEST(StreamSteadiness, DoesNotTakeEvenMotionForLines) {
  // Constant speed has no bends, a sine has no lines.
  StreamSteadiness even, sine;
  for (int i = 0; i < 2000; ++i) {
    even.add({1, 2, 3}, 10'000'000);
    sine.add({std::cos(0.01 * i), 0, 0}, 10'000'000);
  }
  EXPECT_FALSE(even.knots_hz());
  EXPECT_FALSE(sine.knots_hz());
}

}  // namespace
}  // namespace herr
