// `herr bench` for one frame on each instruction set: a smoke test, not a measurement.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/render_settings.h"
#include "tests/missing_tool.h"
#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

bool cpu_has(Isa isa) {
  try {
    resolve_isa(isa);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

void measure_one_frame_on(Isa isa) {
  if (!cpu_has(isa)) GTEST_SKIP() << "this CPU lacks " << name_of(isa);
  const std::filesystem::path source = test::source_dir();
  if (!std::filesystem::exists(source / "scenes/samples/generated/teapot.glb")) {
    HERR_MISSING_TOOL("scenes/samples/generated is missing; an ordinary build makes it");
  }
  const TemporaryFolder folder;
  const std::string line = "cd '" + source.string() + "' && " + test::program_path() +
                           " bench --json --frames 1 --repeats 1 --polar 64x32 --profile xr1-half --isa " +
                           name_of(isa) + " >'" + folder.path().string() + "/out' 2>'" +
                           folder.path().string() + "/err'";
  const int status = std::system(line.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << content_of(folder.path() / "err");
  EXPECT_EQ(content_of(folder.path() / "err"), "");
  const auto json = nlohmann::json::parse(content_of(folder.path() / "out"));
  EXPECT_EQ(json["isa"], name_of(isa));
  EXPECT_EQ(json["frames"], 1);
  for (const char* name : {"frame_ms", "raw_ms", "ns_per_pixel"})
    EXPECT_GT(json[name].get<double>(), 0) << name;
  EXPECT_GT(json["rays"]["primary"]["rays"].get<double>(), 0);
}

TEST(BenchSmoke, MeasuresOneFrameOnSse4) {
  measure_one_frame_on(Isa::sse4);
}

TEST(BenchSmoke, MeasuresOneFrameOnAvx2) {
  measure_one_frame_on(Isa::avx2);
}

TEST(BenchSmoke, MeasuresOneFrameOnAvx512) {
  measure_one_frame_on(Isa::avx512);
}

TEST(BenchSmoke, AveragesRunsAsTheTableOfThePaperDoes) {
  const std::filesystem::path source = test::source_dir();
  if (!std::filesystem::exists(source / "scenes/samples/generated/teapot.glb")) {
    HERR_MISSING_TOOL("scenes/samples/generated is missing; an ordinary build makes it");
  }
  const TemporaryFolder folder;
  const std::string out = folder.path().string() + "/out";
  const std::string line = "cd '" + source.string() + "' && " + test::program_path() +
                           " bench --table --seconds 0.001 --json --frames 1 --polar 64x32 --probes"
                           " --profile xr1-half >'" +
                           out + "'";
  const int status = std::system(line.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  ASSERT_EQ(WEXITSTATUS(status), 0);
  const auto json = nlohmann::json::parse(content_of(out));
  ASSERT_EQ(json["table"].size(), 3u);  // one size, three numbers of light samples
  for (const auto& cell : json["table"]) {
    EXPECT_EQ(cell["polar"], "64x32");
    EXPECT_EQ(cell["frames"], 1);  // any frame takes longer than a millisecond
    EXPECT_GT(cell["frame_ms"].get<double>(), cell["probe_ms"].get<double>());
    EXPECT_GT(cell["probe_ms"].get<double>(), 0);
    EXPECT_GT(cell["raw_ms"].get<double>(), 0);
  }
}

TEST(BenchSmoke, WeighsWhatTheFramePlanLeavesOut) {
  // Spheres and boxes of glass and metal: second rays are planned, textures and catchers are not.
  const TemporaryFolder folder;
  const std::string out = folder.path().string() + "/out";
  const std::string line = "cd '" + std::string(test::source_dir()) + "' && " + test::program_path() +
                           " bench --left-out --json --frames 1 --repeats 1 --polar 64x32 --profile xr1-half"
                           " --scene scenes/samples/shapes.scene.json >'" +
                           out + "'";
  const int status = std::system(line.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  ASSERT_EQ(WEXITSTATUS(status), 0) << "some picture differs";
  const auto json = nlohmann::json::parse(content_of(out));
  std::vector<std::string> names;
  for (const auto& entry : json["left_out"]) {
    names.push_back(entry["name"]);
    EXPECT_EQ(entry["different_values"], 0) << names.back();
    EXPECT_GE(entry["added_bytes"].get<std::int64_t>(), 0) << names.back();
    EXPECT_GT(entry["time_ratio"].get<double>(), 0) << names.back();
  }
  EXPECT_EQ(std::count(names.begin(), names.end(), "textures"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "catchers"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "mirror rays"), 0);
  EXPECT_GT(json["everything"]["added_bytes"].get<std::int64_t>(), 0);
  EXPECT_EQ(json["control"]["added_bytes"], 0);
  EXPECT_EQ(json["memory_bytes"]["textures"], 0);
  EXPECT_GT(json["memory_bytes"]["second rays"].get<std::int64_t>(), 0);
}

}  // namespace
}  // namespace herr
