// Sessions written row by row: what is read back, and what a recorder that died leaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <stdexcept>
#include <string>

#include "sessions/record/session_recorder.h"
#include "sessions/session.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

SessionHeader plain_header() {
  SessionHeader header;
  header.name = "recorded";
  header.profile = xr1_half_profile();
  header.head_from_eye[0].position.x = -0.032;
  header.head_from_eye[1].position.x = 0.032;
  return header;
}

PoseRow pose_at(TimeNs stamp_ns) {
  const double x = static_cast<double>(stamp_ns) * 1e-9 / 3;  // no short decimal
  return {stamp_ns, {{x, 1.6, -x}, glm::normalize(glm::dquat(1, 0.1 * x, 0.2, -0.3))}};
}

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(RecordedSession, ReadsBackBitForBit) {
  const RecordedFolder folder;
  SessionHeader header = plain_header();
  header.profile.name = "mine";  // not a built-in name: written out
  header.vergence_m = 0.7;
  header.gaze_combined = true;
  header.pose_hz = 90;
  SessionRecorder recorder(folder / "s");
  recorder.write_header(header);
  for (int i = 0; i < 20; ++i) recorder.add_pose(pose_at(1'000'000'000 + i * 11'111'111));
  const glm::dvec3 ray = glm::normalize(glm::dvec3(0.1, 0.2, -1));
  recorder.add_gaze({1'000'000'000, {ray, ray}, {true, true}});
  recorder.add_gaze({1'200'000'000, {ray, ray}, {false, false}});
  recorder.finish();
  Session session = Session::open(folder / "s");
  EXPECT_EQ(session.header().name, "recorded");
  EXPECT_EQ(session.header().profile.viewports.size(), xr1_half_profile().viewports.size());
  // atan and tan undo each other to two roundings.
  EXPECT_NEAR(session.header().profile.viewports[0].tan_left, xr1_half_profile().viewports[0].tan_left,
              1e-15);
  EXPECT_EQ(session.header().vergence_m, 0.7);
  EXPECT_EQ(session.findings().pose_rows, 20);
  EXPECT_EQ(session.findings().gaze_rows, 2);
  for (int i = 0; i < 20; ++i) {
    const PoseRow written = pose_at(1'000'000'000 + i * 11'111'111);
    const Pose read = session.sample(written.stamp_ns).head.world_from_head;
    EXPECT_EQ(read.position, written.world_from_head.position);
    // The reader normalises once more: one rounding.
    EXPECT_NEAR(glm::dot(read.orientation, written.world_from_head.orientation), 1, 3e-16);
  }
}

TEST(RecordedSession, HasAColumnForTheLidsInEveryRowOrInNone) {
  const RecordedFolder folder;
  const glm::dvec3 ahead{0, 0, -1};
  SessionRecorder recorder(folder / "s");
  recorder.write_header(plain_header());
  recorder.add_pose(pose_at(0));
  recorder.add_gaze({0, {ahead, ahead}, {true, true}}, 0.75);
  recorder.add_gaze({10'000'000, {ahead, ahead}, {false, false}}, 0.25);
  EXPECT_THROW(recorder.add_gaze({20'000'000, {ahead, ahead}, {true, true}}), std::logic_error);
  recorder.finish();
  EXPECT_EQ(content(folder / "s" / "gaze" / "data.csv"),
            "timestamp_ns,lx,ly,lz,l_valid,rx,ry,rz,r_valid,openness\n"
            "0,0,0,-1,1,0,0,-1,1,0.75\n10000000,0,0,0,0,0,0,0,0,0.25\n");
  EXPECT_EQ(Session::open(folder / "s").findings().gaze_rows, 2);
}

TEST(RecordedSession, OpensWhileItIsBeingRecorded) {
  const RecordedFolder folder;
  SessionRecorder recorder(folder / "s");
  recorder.write_header(plain_header());
  // Five seconds at 100 Hz and no end: rows reach the disk every second of the session's time, so that at
  // least four seconds are there.
  for (int i = 0; i < 500; ++i) recorder.add_pose(pose_at(i * TimeNs{10'000'000}));
  const Session session = Session::open(folder / "s");
  EXPECT_GE(session.findings().pose_rows, 400);
  EXPECT_LT(session.findings().pose_rows, 500);
  EXPECT_FALSE(session.findings().truncated) << "only whole rows are written";
}

TEST(RecordedSession, CutAtAnyByteOfItsLastThreeLinesOpensAndSaysWhatWasLost) {
  const RecordedFolder folder;
  {
    SessionRecorder recorder(folder / "s");
    recorder.write_header(plain_header());
    for (int i = 0; i < 10; ++i) recorder.add_pose(pose_at(i * TimeNs{10'000'000}));
    recorder.finish();
  }
  const std::string whole = content(folder / "s/pose/data.csv");
  std::size_t start = whole.size() - 1;
  for (int line = 0; line < 3; ++line) start = whole.rfind('\n', start - 1);
  for (std::size_t size = start + 1; size < whole.size(); ++size) {
    const std::string part = whole.substr(0, size);
    folder.write("s/pose/data.csv", part);
    const Session session = Session::open(folder / "s");
    const std::string lost = part.substr(part.rfind('\n') + 1);
    const auto rows = std::count(part.begin(), part.end(), '\n') - 1;
    ASSERT_EQ(session.findings().pose_rows, rows) << size;
    ASSERT_EQ(session.findings().truncated, !lost.empty()) << size;
    if (!lost.empty()) {
      ASSERT_PRED2(holds, session.findings().warnings.front(), "'" + lost + "' were dropped");
    }
  }
}

TEST(RecordedSession, RefusesStampsThatDoNotGrowAndFilesThatExist) {
  const RecordedFolder folder;
  SessionRecorder recorder(folder / "s");
  recorder.add_pose(pose_at(5));
  EXPECT_THROW(recorder.add_pose(pose_at(5)), std::logic_error);
  EXPECT_THROW(recorder.add_camera_frame(0, {5, "a,b.png"}), std::logic_error);
  recorder.add_event(7, R"({"t_ns": 7, "op": "x"})");
  recorder.add_event(7, R"({"t_ns": 7, "op": "y"})");
  SessionRecorder second(folder / "s");
  EXPECT_THROW(second.add_pose(pose_at(5)), WriteError);
}

}  // namespace
}  // namespace herr::test
