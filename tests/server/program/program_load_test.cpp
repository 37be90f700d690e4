// Memory and CPU time that the program says it takes, against what it was given to hold and to do.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class ProgramLoad : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_session(root() / "walk", 0.25);
  }
  const fs::path& root() const { return folder_.path(); }

  // One thread and two frames of the large profile, whose pictures are 14.3 Mpx of 8 bytes.
  nlohmann::json summary_of(const std::string& out, const std::string& flags) {
    const Outcome outcome = run_program(root(),
                                        "replay walk --profile xr1 --polar 128x64"
                                        " --contact-sheet none --frames 2 --out " +
                                            out + " " + flags);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("ms of CPU for each frame"), std::string::npos) << outcome.out;
    return nlohmann::json::parse(content_of(root() / out / "walk" / "summary.json"));
  }
  std::vector<double> column(const std::string& out, const std::string& name) {
    std::istringstream lines(content_of(root() / out / "walk" / "frames.csv"));
    std::vector<double> values;
    std::size_t at = std::string::npos;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream cells(line);
      std::size_t i = 0;
      for (std::string cell; std::getline(cells, cell, ','); ++i) {
        if (cell == name) at = i;
        if (i == at && cell != name) values.push_back(std::stod(cell));
      }
    }
    return values;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(ProgramLoad, PartsOfMemoryAreMostOfWhatIsResidentAndNoMore) {
  const nlohmann::json json = summary_of("o", "--format png --threads 1");
  const auto& parts = json["memory_bytes"];
  const double together = parts["together"], resident = json["load"]["peak_resident_bytes"];
  // Two contexts of 1980 x 1980 and two focus pictures of 2400 x 1350, rows padded to vectors; half floats.
  EXPECT_GE(parts["viewport pictures"].get<double>(), 8.0 * 2 * (1980 * 1980 + 2400 * 1350));
  EXPECT_LE(parts["viewport pictures"].get<double>(), 8.0 * 2 * (2048 * 1980 + 2432 * 1350));
  // The camera image of 64 x 48, half floats: one, though both eyes see it.
  EXPECT_EQ(parts["camera pictures"], 64 * 48 * 8);
  // 8-bit RGB of each picture at least.
  EXPECT_GE(parts["encoder buffers"].get<double>(), 3.0 * 2 * (1980 * 1980 + 2400 * 1350));
  EXPECT_LE(together, resident);
  // The program and its libraries take some 60 MB beside 160 MB and more of pictures.
  EXPECT_GE(together, 0.6 * resident);
}

TEST_F(ProgramLoad, ALargerSceneGrowsItsPartByItsBytes) {
  const auto loaded = [&](const std::string& out) {
    return summary_of(out, "--format none --threads 1")["memory_bytes"]["loaded environment"]
        .get<std::int64_t>();
  };
  EXPECT_EQ(loaded("plain"), 0);
  // Radiance without runs: four bytes a pixel in the file, four floats in memory.
  std::string picture = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 128 +X 256\n";
  for (int i = 0; i < 128 * 256; ++i) picture += std::string("\x40\x40\x40\x80", 4);
  write_text(root() / "scene/sky.hdr", picture);
  std::string scene = content_of(root() / "scene/small.scene.json");
  scene.insert(scene.rfind('}'), ", \"environment_map\": {\"file\": \"sky.hdr\"}");
  write_text(root() / "scene/small.scene.json", scene);
  EXPECT_EQ(loaded("sky"), 128 * 256 * 16);
}

TEST_F(ProgramLoad, CpuTimeOfAFrameIsNoMoreThanItsTimeOnEveryCore) {
  const nlohmann::json json = summary_of("o", "--format png --threads 2");
  const std::vector<double> cpu_ms = column("o", "cpu_ms"), frame_ms = column("o", "frame_ms");
  ASSERT_EQ(cpu_ms.size(), 2u);
  ASSERT_EQ(frame_ms.size(), 2u);
  const int cores = json["load"]["cores"];
  double cpu_sum = 0, frame_sum = 0;
  for (std::size_t i = 0; i < cpu_ms.size(); ++i) {
    EXPECT_GT(cpu_ms[i], 0);
    // Read within the frame time: beyond the cores' time lies only what the kernel books late, a tick of 4
    // ms.
    EXPECT_LE(cpu_ms[i], frame_ms[i] * cores + 4.0 * cores);
    cpu_sum += cpu_ms[i], frame_sum += frame_ms[i];
  }
  const auto& load = json["load"];
  EXPECT_NEAR(load["cpu"]["mean"].get<double>(), cpu_sum / 2, 1e-3);
  EXPECT_NEAR(load["cpu_share"].get<double>(), cpu_sum / (frame_sum * cores), 1e-4);
}

}  // namespace
}  // namespace herr
