// Every way in which a stream's rows can be wrong, and what is said about it.
#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>

#include "sessions/files/input_error.h"
#include "sessions/session.h"
#include "tests/missing_tool.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using test::kCameraHeader;
using test::kGazeHeader;
using test::kPoseHeader;
using test::pose_row;
using test::RecordedFolder;

struct Fault {
  std::string name, content, expected;
};

// Two good rows around the bad one, which stands in line 3.
std::string with_row(const std::string& row) {
  return kPoseHeader + pose_row(0, 0) + row + "\n" + pose_row(20'000'000, 0);
}

const Fault kPoseFaults[] = {
    {"empty file", "", "is empty"},
    {"header only", kPoseHeader, "has no samples"},
    {"cut-off header", "timestamp_ns,px", "header line is cut off"},
    {"missing column", "timestamp_ns,px,py,pz,qx,qy,qz\n", "no column qw"},
    {"misspelt column", "timestamp_ns,px,py,pz,qx,qy,qz,qww\n", "no column qw (is it 'qww'?)"},
    {"semicolons", "timestamp_ns;px;py;pz;qx;qy;qz;qw\n0;0;0;0;0;0;0;1\n",
     "data.csv:1: the fields are separated by ';'; write commas"},
    {"tabs", "timestamp_ns\tpx\tpy\tpz\tqx\tqy\tqz\tqw\n", "the fields are separated by tabs; write commas"},
    {"column twice", "timestamp_ns,px,py,pz,qx,qy,qz,qw,px\n", "names column px twice"},
    {"unknown column", "timestamp_ns,px,py,pz,qx,qy,qz,qw,vx\n", "unknown column 'vx'"},
    {"UTF-16 with mark", std::string("\xff\xfet\0i\0", 6), "is UTF-16"},
    {"UTF-16 without mark", std::string("t\0i\0\n\0", 6), "NUL bytes"},
    {"too few fields", with_row("10000000,0,0,0,0,0,0"), "data.csv:3: the line has 7 fields"},
    {"too many fields", with_row("10000000,0,0,0,0,0,0,1,5"), "data.csv:3: the line has 9 fields"},
    {"empty line", with_row(""), "data.csv:3: the line is empty"},
    {"endless line", with_row(std::string(300'000, '1')), "data.csv:3: the line is longer"},
    {"not a number", with_row("10000000,a,0,0,0,0,0,1"), "data.csv:3: column px is 'a', not a finite number"},
    {"NaN", with_row("10000000,nan,0,0,0,0,0,1"), "column px is 'nan', not a finite number"},
    {"infinite", with_row("10000000,0,inf,0,0,0,0,1"), "column py is 'inf', not a finite number"},
    {"too large", with_row("10000000,0,0,1e999,0,0,0,1"), "column pz is '1e999', out of range"},
    {"letters behind", with_row("10000000,0,0,1m,0,0,0,1"), "column pz is '1m', not a finite number"},
    {"hexadecimal", with_row("10000000,0x1,0,0,0,0,0,1"), "column px"},
    {"empty field", with_row("10000000,,0,0,0,0,0,1"), "column px is '', not a finite number"},
    {"control bytes", with_row("10000000,\x1b[2J,0,0,0,0,0,1"), "column px is '\\x1b[2J'"},
    {"decimal comma", with_row("10000000;0,5;0;0;0;0;0;1"), "the line has 2 fields"},
    {"far away", with_row("10000000,1e9,0,0,0,0,0,1"), "1e9 m or more"},
    {"far beyond", with_row("10000000,1e300,1e300,0,0,0,0,1"), "1e9 m or more"},
    {"zero quaternion", with_row("10000000,0,0,0,0,0,0,0"), "the zero quaternion"},
    {"long quaternion", with_row("10000000,0,0,0,0,0,0,1.0011"), "not a unit quaternion"},
    {"stamp with fraction", with_row("10000000.5,0,0,0,0,0,0,1"),
     "timestamp_ns is '10000000.5', not a whole number"},
    {"stamp with exponent", with_row("1e7,0,0,0,0,0,0,1"), "timestamp_ns is '1e7', not a whole number"},
    {"negative stamp", with_row("-1,0,0,0,0,0,0,1"), "timestamp_ns is '-1', out of range"},
    {"stamp of 2^63", with_row("9223372036854775808,0,0,0,0,0,0,1"), "out of range"},
    {"stamp of 2^63-1", with_row("9223372036854775807,0,0,0,0,0,0,1"), "out of range"},
    {"repeated stamp", with_row("0,0,0,0,0,0,0,1"), "data.csv:3: time stamp 0 repeats the one before"},
    {"backward stamp", with_row("30000000,0,0,0,0,0,0,1"),
     "data.csv:4: time stamp 20000000 goes backwards by 10000000 ns"},
};

TEST(PoseStream, RefusesEveryFaultWithLineAndReason) {
  for (const Fault& fault : kPoseFaults) {
    const RecordedFolder folder;
    write_good_session(folder);
    folder.write("pose/data.csv", fault.content);
    EXPECT_INPUT_ERROR(Session::open(folder.path()), fault.expected) << fault.name;
  }
}

TEST(PoseStream, SkipsAndCountsBadRowsWhenToldToKeepGoing) {
  const RecordedFolder folder;
  write_good_session(folder);
  std::string rows = kPoseHeader + pose_row(0, 0);
  rows += "x,0,0,0,0,0,0,1\n\n1,2\n0,0,0,0,0,0,0,1\n5,0,0,0,0,0,0,0\n" + std::string(300'000, '1') + "\n";
  rows += pose_row(10'000'000, 1) + pose_row(20'000'000, 2);
  folder.write("pose/data.csv", rows);
  SessionOptions options;
  options.keep_going = true;
  Session session = Session::open(folder.path(), options);
  EXPECT_EQ(session.findings().skipped_rows, 6);
  EXPECT_EQ(session.findings().pose_rows, 3);
  EXPECT_EQ(session.findings().warnings.size(), 6u);
  EXPECT_EQ(session.sample(10'000'000).head.world_from_head.position.x, 1) << "replay skips the same rows";
}

TEST(PoseStream, WithNothingButBadRowsIsAnErrorEvenWhenToldToKeepGoing) {
  const RecordedFolder folder;
  write_good_session(folder);
  folder.write("pose/data.csv", kPoseHeader + "x,0,0,0,0,0,0,1\n");
  SessionOptions options;
  options.keep_going = true;
  EXPECT_INPUT_ERROR(Session::open(folder.path(), options), "has no samples");
}

TEST(GazeStream, RefusesEveryFaultWithLineAndReason) {
  const Fault faults[] = {
      {"flag of 2", "0,0,0,-1,2,0,0,-1,1", "column l_valid is '2'"},
      {"zero vector", "0,0,0,0,1,0,0,-1,1", "the left gaze is the zero vector"},
      {"long vector", "0,0,0,-1,1,0,0,-1.02,1", "the right gaze is not a unit vector"},
      {"NaN of a closed eye", "0,nan,0,0,0,0,0,-1,1", "column lx is 'nan'"},
  };
  for (const Fault& fault : faults) {
    const RecordedFolder folder;
    write_good_session(folder);
    folder.write("gaze/data.csv", kGazeHeader + fault.content + "\n");
    EXPECT_INPUT_ERROR(Session::open(folder.path()), "data.csv:2: " + fault.expected) << fault.name;
  }
}

TEST(GazeStream, MayHaveMoreColumnsInAnyOrder) {
  const RecordedFolder folder;
  write_good_session(folder);
  folder.write("gaze/data.csv",
               "openness, r_valid,rz,ry,rx,l_valid,lz,ly,lx,timestamp_ns\r\nn/a, 1,-1,0,0, 1,-1,0,0 ,0\r\n");
  Session session = Session::open(folder.path());
  EXPECT_EQ(session.sample(0).gaze.source[0], SampleSource::exact);
}

TEST(Streams, AcceptWindowsLineEndsAndAByteOrderMark) {
  const RecordedFolder folder;
  write_good_session(folder);
  folder.write(
      "pose/data.csv",
      "\xef\xbb\xbftimestamp_ns,px,py,pz,qx,qy,qz,qw\r\n0,1,2,3,0,0,0,1\r\n10000000,1,2,3,0,0,0,1\r\n");
  Session session = Session::open(folder.path());
  EXPECT_EQ(session.findings().pose_rows, 2);
  EXPECT_EQ(session.sample(0).head.world_from_head.position, glm::dvec3(1, 2, 3));
}

TEST(Streams, ReadNumbersAlikeInALocaleWithDecimalCommas) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) HERR_MISSING_TOOL("no such locale here");
  const RecordedFolder folder;
  write_good_session(folder);
  folder.write("pose/data.csv", kPoseHeader + "0,1.5,0,0,0,0,0,1\n");
  const double x = Session::open(folder.path()).sample(0).head.world_from_head.position.x;
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_EQ(x, 1.5);
}

TEST(Streams, AreNormalisedWithinTheirSlack) {
  const RecordedFolder folder;
  write_good_session(folder);
  folder.write("pose/data.csv", kPoseHeader + "0,0,0,0,0,0,0,1.0009\n");
  folder.write("gaze/data.csv", kGazeHeader + "0,0,0,-1.009,1,0,0,-0.991,1\n");
  const FrameSample frame = Session::open(folder.path()).sample(0);
  EXPECT_EQ(frame.head.world_from_head.orientation.w, 1);
  EXPECT_EQ(frame.gaze.head_direction[0], glm::dvec3(0, 0, -1));
  EXPECT_EQ(frame.gaze.head_direction[1], glm::dvec3(0, 0, -1));
}

TEST(Streams, InAnotherUnitOfTimeAreRefused) {
  const RecordedFolder folder;
  write_good_session(folder);
  std::string microseconds = kPoseHeader, picoseconds = kPoseHeader;
  for (int i = 0; i < 20; ++i) {
    microseconds += pose_row(i * 11'111LL, 0);         // 90 Hz in microseconds
    picoseconds += pose_row(i * 11'111'111'111LL, 0);  // 90 Hz in picoseconds
  }
  folder.write("pose/data.csv", microseconds);
  EXPECT_INPUT_ERROR(Session::open(folder.path()), "multiply microseconds by 1000");
  folder.write("pose/data.csv", picoseconds);
  EXPECT_INPUT_ERROR(Session::open(folder.path()), "more than 10 s apart");
}

TEST(Streams, WithAPauseOfHoursStayLegalAndSaySo) {
  const RecordedFolder folder;
  write_good_session(folder);
  std::string rows = kPoseHeader;
  for (int i = 0; i < 10; ++i) rows += pose_row(i * 10'000'000LL, 0);
  for (int i = 0; i < 10; ++i) rows += pose_row(7'200'000'000'000LL + i * 10'000'000LL, 1);
  folder.write("pose/data.csv", rows);
  const Session session = Session::open(folder.path());
  ASSERT_EQ(session.findings().warnings.size(), 1u);
  // Line 12 is the first after the pause: header, ten rows, then it. 7200 s - 0.09 s = 7199910 ms.
  EXPECT_PRED2(test::holds, session.findings().warnings[0], "data.csv:12: a gap of 7199910 ms");
}

TEST(Streams, OfAnotherClockAreRefused) {
  const RecordedFolder folder;
  write_good_session(folder);
  folder.write("gaze/data.csv", kGazeHeader + test::gaze_row(5'000'000'000, 0, true, 0, true));
  EXPECT_INPUT_ERROR(Session::open(folder.path()), "one clock");
}

// What a recorder that was killed leaves behind: the file ends after any byte of its last three lines.
void cut_everywhere(const std::string& stream, const std::string& content, int header_lines) {
  const RecordedFolder folder;
  write_good_session(folder);
  std::size_t start = content.size();
  for (int lines = 0; lines < 4 && start > 0; --start)
    if (content[start - 1] == '\n' && ++lines == 4) break;
  ASSERT_GT(start, 0u);
  for (std::size_t length = start; length <= content.size(); ++length) {
    folder.write(stream, std::string_view(content).substr(0, length));
    const Session session = Session::open(folder.path());
    const SessionFindings& findings = session.findings();
    const std::string kept = content.substr(0, length);
    const std::size_t last_end = kept.rfind('\n') + 1;
    const auto lines = std::count(kept.begin(), kept.end(), '\n');
    EXPECT_EQ(findings.truncated, last_end < length) << length;
    const std::int64_t rows = stream[0] == 'p'   ? findings.pose_rows
                              : stream[0] == 'g' ? findings.gaze_rows
                                                 : findings.event_rows;
    EXPECT_EQ(rows, lines - header_lines) << length;
    if (!findings.truncated) continue;
    ASSERT_EQ(findings.warnings.size(), 1u) << length;
    EXPECT_PRED2(test::holds, findings.warnings[0],
                 ":" + std::to_string(lines + 1) + ": the file ends within this line; its " +
                     std::to_string(length - last_end) + " bytes '" + printable(kept.substr(last_end)) + "'");
    SessionOptions strict;
    strict.strict = true;
    EXPECT_INPUT_ERROR(Session::open(folder.path(), strict), "ends within this line");
  }
}

TEST(CutOffStream, AlwaysOpensUpToItsLastWholeLineAndSaysWhatWasLost) {
  std::string poses = kPoseHeader, gaze = kGazeHeader, events;
  for (int i = 0; i < 6; ++i) {
    poses += pose_row(i * 10'000'000LL, 0.125 * i);
    gaze += test::gaze_row(i * 10'000'000LL, i, true, i, true);
    events += "{\"t_ns\": " + std::to_string(i) + ", \"op\": \"remove\", \"id\": \"a\"}\n";
  }
  cut_everywhere("pose/data.csv", poses, 1);
  cut_everywhere("gaze/data.csv", gaze, 1);
  cut_everywhere("events.jsonl", events, 0);
}

}  // namespace
}  // namespace herr
