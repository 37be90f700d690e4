// Inspect refuses exactly what replay refuses.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/session.h"
#include "tests/sessions/inspect/inspected_folder.h"

namespace herr {
namespace {

using test::inspected;
using test::RecordedFolder;
using test::write_camera_session;
constexpr TimeNs kMs = 1'000'000;

struct Fault {
  std::string name;
  std::function<void(const RecordedFolder&)> make;
  bool refused = true, strict = false, skippable = false;
};

std::vector<Fault> faults() {
  const auto poses = [](const std::string& rows) {
    return [rows](const RecordedFolder& f) { f.write("pose/data.csv", test::kPoseHeader + rows); };
  };
  const auto gaze = [](const std::string& rows) {
    return [rows](const RecordedFolder& f) { f.write("gaze/data.csv", test::kGazeHeader + rows); };
  };
  const auto file = [](const std::string& name, const std::string& text) {
    return [name, text](const RecordedFolder& f) { f.write(name, text); };
  };
  const auto gone = [](const std::string& name) {
    return [name](const RecordedFolder& f) { std::filesystem::remove_all(f / name); };
  };
  const std::string first = test::pose_row(0, 0);
  return {
      {"none", [](const RecordedFolder&) {}, false},
      {"no header", gone("session.json")},
      {"header cut off", file("session.json", "{")},
      {"unknown field", file("session.json", test::header_json("\"colour\": 1"))},
      {"newer version", file("session.json", R"({"format_version": 2})")},
      {"span past the poses", file("session.json", test::header_json("\"start_ns\": 100000000"))},
      {"span past the poses, and an event that replay reads before it sees that",
       [](const RecordedFolder& f) {
         f.write("session.json",
                 test::header_json(test::cameras_json(1, 6, 4) + ", \"start_ns\": 100000000"));
         f.write("events.jsonl", "{}\n");
       }},
      {"eyes far apart",
       file("session.json", test::header_json(R"("eye_offsets": {"left": [-1, 0, 0], "right": [1, 0, 0]})")),
       false},
      {"no poses", gone("pose")},
      {"empty poses", file("pose/data.csv", "")},
      {"poses without rows", poses("")},
      {"repeated stamp", poses(first + test::pose_row(0, 1)), true, false, true},
      {"backward stamp", poses(test::pose_row(9 * kMs, 0) + first), true, false, true},
      {"no unit quaternion", poses(first + "10000000,0,0,0,0,0,0,2\n"), true, false, true},
      {"zero quaternion", poses(first + "10000000,0,0,0,0,0,0,0\n"), true, false, true},
      {"not a number", poses(first + "10000000,nan,0,0,0,0,0,1\n"), true, false, true},
      {"too few fields", poses(first + "10000000,0\n"), true, false, true},
      {"microseconds", poses(first + test::pose_row(10'000, 0) + test::pose_row(20'000, 0))},
      {"cut off", poses(first + test::pose_row(10 * kMs, 0) + "20000000,0"), false},
      {"cut off, strict", poses(first + test::pose_row(10 * kMs, 0) + "20000000,0"), true, true},
      {"no gaze", gone("gaze"), false},
      {"gaze is a folder",
       [](const RecordedFolder& f) {
         std::filesystem::remove(f / "gaze/data.csv");
         std::filesystem::create_directory(f / "gaze/data.csv");
       }},
      {"gaze of another clock", gaze(test::gaze_row(5'000 * kMs, 0, true, 0, true))},
      {"gaze flag", gaze("0,0,0,-1,yes,0,0,-1,1\n"), true, false, false},
      {"no unit gaze", gaze(test::gaze_row(0, 0, true, 0, true) + "10000000,0,0,-2,1,0,0,-1,1\n"), true,
       false, true},
      {"missing picture", gone("cam0/data/b.png"), true, false, true},
      {"picture outside", file("cam0/data.csv", test::kCameraHeader + "0,../a.png\n40000000,b.png\n"), true,
       false, true},
      {"no picture at all", file("cam0/data/b.png", "hello"), true, false, true},
      {"picture of another size", [](const RecordedFolder& f) { f.write_image("cam0/data/c.png", 5, 4); },
       true, false, true},
      {"no camera rows", gone("cam0/data.csv")},
      {"camera without intrinsics", file("session.json", test::header_json()), false},
      {"good event", file("events.jsonl", "{\"t_ns\": 0, \"op\": \"move\"}\n"), false},
      {"bad event", file("events.jsonl", "{\"op\": \"move\"}\n"), true, false, true},
  };
}

TEST(Inspection, RefusesWhatReplayRefusesInTheSameWords) {
  for (const Fault& fault : faults()) {
    SCOPED_TRACE(fault.name);
    const RecordedFolder folder;
    write_camera_session(folder);
    fault.make(folder);
    SessionOptions options;
    options.strict = fault.strict;
    const std::string refusal = test::error_of([&] { Session::open(folder.path(), options); });
    const SessionInspection got = inspected(folder, fault.strict);
    const Finding* first = got.findings.first_error();
    EXPECT_EQ(first != nullptr, fault.refused);
    EXPECT_EQ(first != nullptr ? first->text() : "no error", refusal);
    // And what it calls skippable is what --keep-going skips.
    options.keep_going = true;
    const bool opens = test::error_of([&] { Session::open(folder.path(), options); }) == "no error";
    EXPECT_EQ(got.findings.skippable_errors() == got.findings.count(Severity::error), opens);
    EXPECT_EQ(opens, fault.skippable || !fault.refused);
    if (!opens || !fault.refused) continue;
    const SessionFindings skipped = Session::open(folder.path(), options).findings();
    EXPECT_EQ(got.findings.skippable_errors(), skipped.skipped_rows + skipped.skipped_images);
  }
}

}  // namespace
}  // namespace herr
