// Sweeps by their names.
#include "server/study/plan/only_sweeps.h"

#include <gtest/gtest.h>

#include <set>

#include "server/process/exit_code.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// With adaptive samples, which are swept only where there are any.
StudySweeps some_sweeps() {
  Scene scene;
  test::add(scene, test::floor_quad(5), test::matte(glm::vec3{0.8f}));
  scene.lights = {test::light_at({0, 3, 0}, glm::vec3{10.0f}, {1, 0, 1})};
  return sweeps_of({}, [&](const RenderSettings& s) { return plan_frame(scene, s, false); });
}

TEST(OnlySweeps, EverySweepHasItsNameInTheList) {
  const std::vector<std::string> names = sweep_names();
  const std::set<std::string> known(names.begin(), names.end());
  EXPECT_EQ(known.size(), names.size());
  for (const Knob& knob : some_sweeps().knobs) {
    if (knob.name == "default") continue;
    EXPECT_TRUE(known.contains(knob.name)) << knob.name;
  }
  for (const char* name : {"polar", "polar_width", "light_samples", "edge_samples", "filter", "uniform",
                           "paper", "adaptive_samples", "reflections"})
    EXPECT_TRUE(known.contains(name)) << name;
  EXPECT_FALSE(known.contains("scale") || known.contains("foveation") || known.contains("default"));
}

TEST(OnlySweeps, KeepsThoseAndTheDefaultWithTheirPointsOfIt) {
  StudySweeps sweeps = some_sweeps();
  keep_only({"edge_samples", "filter"}, sweeps);
  std::set<std::string> knobs, of_default;
  for (const StudySetting& setting : sweeps.settings) knobs.insert(setting.knob);
  for (const StudySetting& setting : sweeps.of_default) of_default.insert(setting.knob);
  EXPECT_EQ(knobs, (std::set<std::string>{"default", "edge_samples", "filter"}));
  EXPECT_EQ(of_default, (std::set<std::string>{"edge_samples", "filter"}));
  EXPECT_EQ(sweeps.knobs.size(), 3u);
  // Hard light first, whole.
  bool soft = false;
  for (const StudySetting& setting : sweeps.settings) {
    EXPECT_FALSE(soft && setting.base == "N = 1") << setting.name;
    soft = soft || setting.base == "N = 64";
  }
  EXPECT_EQ(sweeps.settings.front().name, "default, N = 1");
}

TEST(OnlySweeps, NamesTheNearestOfOneThatIsNone) {
  StudySweeps sweeps = some_sweeps();
  const std::size_t all = sweeps.settings.size();
  try {
    keep_only({"polr"}, sweeps);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'polar'?"), std::string::npos) << error.what();
  }
  keep_only({}, sweeps);
  EXPECT_EQ(sweeps.settings.size(), all);
}

}  // namespace
}  // namespace herr
