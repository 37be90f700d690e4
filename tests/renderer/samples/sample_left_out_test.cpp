// Every sample scene against kernels with everything on: what the frame plan leaves out changes no bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "scenes/load_scene.h"
#include "tests/missing_tool.h"
#include "tests/paths.h"
#include "tests/renderer/busy_scene.h"
#include "tests/renderer/rendered_frames.h"

namespace herr {
namespace {

std::vector<std::filesystem::path> sample_scenes() {
  std::vector<std::filesystem::path> found;
  const std::filesystem::path samples = std::filesystem::path(test::source_dir()) / "scenes" / "samples";
  for (const auto& entry : std::filesystem::directory_iterator(samples)) {
    if (entry.path().string().ends_with(".scene.json")) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

class SampleLeftOutTest : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(SampleLeftOutTest, EverythingOnGivesTheSameBits) {
  if (!std::filesystem::exists(GetParam().parent_path() / "generated" / "teapot.glb")) {
    HERR_MISSING_TOOL("scenes/samples/generated is missing; an ordinary build makes it");
  }
  const Scene scene = load_scene(GetParam());
  RenderSettings lean = test::small_settings();
  lean.polar_width = 192;
  lean.polar_height = 160;
  lean.light_samples = 4;
  lean.threads = 2;
  lean.isa = Isa::best;
  RenderSettings full = lean;
  full.force = left_out(plan_frame(scene, lean, true));
  ASSERT_FALSE(full.force.empty()) << "nothing is left out: this test would compare a frame with itself";
  const test::TestCamera camera = test::gradient_camera();
  Renderer as_planned(scene, test::small_profile(160, 240, 144), lean, true),
      everything_on(scene, test::small_profile(160, 240, 144), full, true);
  EXPECT_TRUE(left_out(everything_on.plan()).empty());
  const auto scratch = [](const Renderer& renderer) {
    std::int64_t bytes = 0;
    for (const MemoryEntry& entry : renderer.memory()) {
      bytes += entry.name == "acceleration structures" ? 0 : entry.bytes;
    }
    return bytes;
  };
  EXPECT_GE(scratch(everything_on), scratch(as_planned));
  // From the middle of the room and from its end, the gaze to both sides.
  const std::vector<FrameSample> samples{test::sample_from({0, 1.3, 1.5}, test::gaze_deg(10, -5)),
                                         test::sample_from({0.1, 1.6, 3.6}, test::gaze_deg(-20, -10))};
  for (FrameSample sample : samples) {
    camera.attach_to(sample);
    RenderedFrame planned, complete;
    test::render_with(as_planned, scene, sample, planned);
    test::render_with(everything_on, scene, sample, complete);
    test::expect_same_bits(planned, complete);
    EXPECT_GT(planned.counters.rays[RayKind::primary], 0);
  }
}

std::string name_of_sample(const testing::TestParamInfo<std::filesystem::path>& sample) {
  std::string name = sample.param.filename().string();
  name.resize(name.find('.'));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Samples, SampleLeftOutTest, testing::ValuesIn(sample_scenes()), name_of_sample);

}  // namespace
}  // namespace herr
