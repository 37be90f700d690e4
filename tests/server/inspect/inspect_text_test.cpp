// The plot and the counts of `herr inspect`, against what is drawn or counted by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "scenes/load_scene.h"
#include "server/inspect/scene_facts.h"
#include "server/inspect/scene_text.h"
#include "server/inspect/time_plot.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

ProfileSpan span(double mean, double peak, std::int64_t values = 1, std::int64_t without = 0) {
  return {peak, mean * static_cast<double>(values), values, without};
}

TEST(TimePlot, DrawsMeanAndPeakAndWhatIsLost) {
  std::vector<ProfileSpan> spans(kPlotColumns, span(1, 1));
  spans[0] = span(10, 10);
  spans[1] = span(4, 8, 2, 1);
  spans[2] = span(0, 0, 0, 3);
  const std::vector<std::string> lines = lines_of(time_plot(spans, {"speed", 5, true, 12.5}));
  ASSERT_EQ(lines.size(), 9u);
  EXPECT_EQ(lines[0], "speed");
  // Rows of 2: 10 fills five, 4 two with a peak of four, 1 rounds to one (half a row rounds up).
  EXPECT_EQ(lines[1], "      10 |#");
  EXPECT_EQ(lines[2], "       8 |#:");
  EXPECT_EQ(lines[3], "       6 |#:");
  EXPECT_EQ(lines[4], "       4 |##");
  EXPECT_EQ(lines[5], "       2 |## " + std::string(kPlotColumns - 3, '#'));
  EXPECT_EQ(lines[6], "         +" + std::string(kPlotColumns, '-'));
  EXPECT_EQ(lines[7].substr(lines[7].size() - 7), "12.50 s");
  EXPECT_EQ(lines[8], "    lost | -x");
  for (const std::string& line : lines) EXPECT_LE(line.size(), 80u) << line;
}

TEST(TimePlot, ScalesToARoundNumberAboveThePeak) {
  EXPECT_EQ(round_scale(0), 1);
  EXPECT_EQ(round_scale(1), 1);
  EXPECT_EQ(round_scale(137), 150);
  EXPECT_EQ(round_scale(810), 1000);
  EXPECT_EQ(round_scale(0.05), 0.05);
}

TEST(SceneFacts, CountObjectsTrianglesAndMemory) {
  const TemporaryFolder folder;
  write_small_scene(folder.path());
  const SceneFacts facts = facts_of(load_scene(folder.path() / "small.scene.json"));
  EXPECT_EQ(facts.instances, 2);
  EXPECT_EQ(facts.catchers, 1);
  EXPECT_EQ(facts.triangles, 1);
  EXPECT_EQ(facts.catcher_triangles, 2);
  EXPECT_EQ(facts.degenerate_triangles, 0);
  EXPECT_EQ(facts.lights, 1);
  EXPECT_EQ(facts.moving_lights, 0);
  // 3 + 4 corners of position and normal, 12 bytes each, and 3 triangles of 12 bytes.
  EXPECT_EQ(facts.geometry_bytes, 7 * 24 + 3 * 12);
  ASSERT_EQ(facts.objects.size(), 2u);
  EXPECT_EQ(facts.objects[0].name, "floor");
  EXPECT_TRUE(facts.objects[0].catcher);
  EXPECT_EQ(facts.bounds.upper.y, 2);
}

TEST(SceneFacts, CountObjectsThatFollowAPath) {
  const TemporaryFolder folder;
  write_text(folder.path() / "path.scene.json", R"({"format_version": 1, "name": "path", "shapes": [
    {"name": "ball", "sphere": {"centre": [0, 0, 0], "radius": 1}, "path": {"keys": [{"t_s": 0}]}},
    {"name": "bead", "sphere": {"centre": [0, 0, 0], "radius": 1}}]})");
  InspectReport report;
  report.scene = facts_of(load_scene(folder.path() / "path.scene.json"));
  EXPECT_EQ(report.scene->moving_objects, 1);
  EXPECT_NE(scene_text(report).find("1 object follows a path of its own"), std::string::npos);
}

TEST(SceneFacts, CountTrianglesThatNoRayCanHit) {
  Scene scene;
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.triangles = {{0, 1, 3}, {0, 1, 2}, {3, 3, 1}};  // the second lies on a line, the third has two corners
  scene.meshes.push_back(mesh);
  EXPECT_EQ(facts_of(scene).degenerate_triangles, 2);
}

}  // namespace
}  // namespace herr
