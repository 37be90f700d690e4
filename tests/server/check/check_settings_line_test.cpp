// The line of a report that says what was measured, as flags.
#include <gtest/gtest.h>

#include <string>

#include "renderer/settings_presets.h"
#include "server/check/run_length.h"
#include "server/results/fingerprint.h"

namespace herr {
namespace {

std::string line_of(const RenderSettings& render) {
  ReplayOptions options;
  options.render = render;
  CheckFingerprint fingerprint;
  fingerprint.work.settings = setting_entries(options);
  fingerprint.machine = {{"--threads", "2"}, {"the CPU", "any"}};
  return settings_line(fingerprint);
}

// --preset direct stands for --occlusion-rays 0 and --no-probes. Nobody gave --no-occlusion-smoothing, which
// has no meaning without short rays.
TEST(CheckSettingsLine, TellsWhatAPresetStandsForAsFlags) {
  const std::string direct = line_of(direct_light_settings());
  EXPECT_NE(direct.find("--light-samples 1, --occlusion-rays 0, --no-probes"), std::string::npos) << direct;
  EXPECT_NE(direct.find(", --threads 2"), std::string::npos) << direct;
  const std::string paper = line_of({});
  EXPECT_NE(paper.find("--light-samples 1, --occlusion-rays 1, --probes"), std::string::npos) << paper;
  for (const std::string& line : {direct, paper}) {
    EXPECT_EQ(line.find("given"), std::string::npos) << line;
    EXPECT_EQ(line.find("smoothing"), std::string::npos) << line;
  }
}

TEST(CheckSettingsLine, TellsASwitchThatWasGiven) {
  RenderSettings render;
  render.occlusion_smoothing = false;
  render.camera = false;
  const std::string line = line_of(render);
  EXPECT_NE(line.find(", --no-occlusion-smoothing"), std::string::npos) << line;
  EXPECT_NE(line.find(", --no-camera"), std::string::npos) << line;
  EXPECT_EQ(line.find("given"), std::string::npos) << line;
}

}  // namespace
}  // namespace herr
