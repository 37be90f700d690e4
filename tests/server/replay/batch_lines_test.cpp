// What a replay of several sessions says of them together.
#include "server/replay/batch_lines.h"

#include <gtest/gtest.h>

namespace herr {
namespace {

SessionReport report_of(const std::string& name, ReplayState state, int exit_code) {
  SessionReport report;
  report.name = name;
  report.session_folder = "night/" + name;
  report.scene_file = report.session_folder / "../room/room.scene.json";
  report.state = state;
  report.exit_code = exit_code;
  return report;
}

SessionReport broken() {
  SessionReport report = report_of("broken", ReplayState::failed, 3);
  report.error = "broken/pose/data.csv:20: is bad";
  report.unopened = true;
  return report;
}

TEST(BatchLines, SessionsThatAreDoneInPartAreNamedWithWhatTheyLack) {
  const SessionReport whole = report_of("morning", ReplayState::done, 0);
  SessionReport rows = report_of("noon", ReplayState::done, 5),
                both = report_of("night", ReplayState::done, 5);
  rows.findings.skipped_rows = 1;
  both.findings.skipped_rows = 3;
  both.findings.skipped_images = 2;
  EXPECT_EQ(
      closing_line({whole, rows, both}, {}, {}),
      "3 of 3 sessions done, 2 of them in part: noon (1 row left out, exit 5), night (3 rows and 2 images "
      "left out, exit 5)");
  EXPECT_EQ(closing_line({whole, whole}, {}, {}), "");
}

TEST(BatchLines, AfterASignalRefusedSessionsAreNotAmongThoseThatWereNotBegun) {
  const std::vector<SessionReport> reports{report_of("morning", ReplayState::interrupted, 143), broken()};
  const std::string line =
      "0 of 3 sessions done, 1 failed: broken (broken/pose/data.csv:20: is bad, exit 3), 1 interrupted: "
      "morning, 1 not begun: noon";
  ReplayOptions options;
  EXPECT_EQ(closing_line(reports, {"noon"}, options), line + "; the same command with --resume goes on");
  options.resume = true;
  EXPECT_EQ(closing_line(reports, {"noon"}, options), line + "; the same command goes on");
  options.resume = false;
  options.overwrite = true;
  EXPECT_EQ(closing_line(reports, {"noon"}, options),
            line + "; the same command with --resume in place of --overwrite goes on");
  options.policy.deadline = true;  // its frames are not made twice alike
  EXPECT_EQ(closing_line(reports, {"noon"}, options), line);
  // Nothing to go on with.
  EXPECT_EQ(closing_line({broken()}, {}, {}),
            "0 of 1 sessions done, 1 failed: broken (broken/pose/data.csv:20: is bad, exit 3)");
}

TEST(BatchLines, WarningsNameTheirSessionAndThoseOfTheSceneComeOnce) {
  std::set<std::string> said;
  SessionReport morning = report_of("morning", ReplayState::done, 0);
  morning.warnings = {"no virtual object was in view", "night/morning/pose/data.csv:3: is odd",
                      "night/morning/../room/room.scene.json: no lights",
                      "night/morning/../room/lamp.glb: is dark"};
  EXPECT_EQ(
      batch_warnings(morning, {"night/morning/../room/lamp.glb: is dark"}, said),
      (std::vector<std::string>{
          "morning: no virtual object was in view", "night/morning/pose/data.csv:3: is odd",
          "night/morning/../room/room.scene.json: no lights", "night/morning/../room/lamp.glb: is dark"}));
  // The same two of the same scene, seen from another folder, and one more.
  SessionReport noon = report_of("noon", ReplayState::done, 0);
  noon.warnings = {"no virtual object was in view", "night/noon/../room/room.scene.json: no lights",
                   "night/noon/../room/lamp.glb: is dark", "night/noon/../room/room.scene.json: no feed",
                   "night/noon2/a: is of another folder"};
  EXPECT_EQ(batch_warnings(noon, {"night/noon/../room/lamp.glb: is dark"}, said),
            (std::vector<std::string>{"noon: no virtual object was in view",
                                      "night/noon/../room/room.scene.json: no feed",
                                      "noon: night/noon2/a: is of another folder"}));
}

}  // namespace
}  // namespace herr
