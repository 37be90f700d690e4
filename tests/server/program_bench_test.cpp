// `herr bench` for one frame on each instruction set: a smoke test, not a measurement.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "renderer/render_settings.h"
#include "temporary_folder.h"
#include "tests/paths.h"

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
    GTEST_SKIP() << "scenes/samples/generated is missing; an ordinary build makes it";
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

}  // namespace
}  // namespace herr
