// Memory of a long replay, seen from outside: it does not grow with the number of frames or with the length
// of the session.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "tests/paths.h"
#include "tests/server/program/child_program.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;
constexpr std::int64_t kFramesBeforeMeasuring = 500;
constexpr std::int64_t kMostGrowthKb = 5 * 1024;

// VmRSS of a process in kB; 0 when it is gone.
std::int64_t resident_kb(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string row; std::getline(status, row);)
    if (row.starts_with("VmRSS:")) return std::stoll(row.substr(6));
  return 0;
}

// Counts the rows of a growing file without reading a byte twice.
class RowCounter {
 public:
  std::int64_t count_in(const fs::path& folder) {
    if (!file_.is_open()) {
      std::error_code not_there_yet;
      for (const auto& entry : fs::directory_iterator(folder, not_there_yet))
        if (entry.path().filename().string().starts_with("frames.csv")) file_.open(entry.path());
    }
    if (!file_.is_open()) return 0;
    file_.clear();
    char buffer[1 << 16];
    do {
      file_.read(buffer, sizeof buffer);
      rows_ += std::count(buffer, buffer + file_.gcount(), '\n');
    } while (file_.gcount() > 0);
    return rows_ - 1;  // the heading
  }

 private:
  std::ifstream file_;
  std::int64_t rows_ = 0;
};

struct Memory {
  std::int64_t frames = 0;  // when first_kb was read
  std::int64_t first_kb = 0, most_kb = 0, last_kb = 0;
  std::int64_t growth_kb() const { return most_kb - first_kb; }
};

class LongReplay : public ::testing::Test {
 protected:
  const fs::path& root() const { return folder_.path(); }

  // An hour of a person who walks up and down.
  void SetUp() override {
    write_small_scene(root() / "scene");
    // Tiny viewports: the smallest work for a frame, so that ten thousand take seconds.
    write_text(root() / "tiny.json", R"({"name": "tiny", "display_hz": 60, "viewports": [
{"name": "left", "eye": "left", "kind": "context", "width_px": 8, "height_px": 8, "left_deg": -45, "right_deg": 45,
 "down_deg": -45, "up_deg": 45, "edge_blend_deg": 0},
{"name": "right", "eye": "right", "kind": "context", "width_px": 8, "height_px": 8, "left_deg": -45,
 "right_deg": 45, "down_deg": -45, "up_deg": 45, "edge_blend_deg": 0}]})");
    ChildProgram synth(root(), {test::program_path(), "synth", "hour", "--duration", "3600", "--motion",
                                "walking", "--profile", "tiny.json", "--replay-scene",
                                "../scene/small.scene.json", "--hitches-per-minute", "2"});
    ASSERT_EQ(synth.finish(), 0) << content_of(root() / "stderr.txt");
  }

  Memory replay(const std::string& format, std::int64_t frames) {
    ChildProgram child(root(), {test::program_path(), "replay", "hour", "--preset", "direct", "--polar",
                                "16x8", "--format", format, "--contact-sheet", "none", "--frames",
                                std::to_string(frames), "--out", "o", "--threads", "2"});
    Memory memory;
    RowCounter rows;
    // Its result waits in a full pipe: the process is still there after its last frame.
    while (child.runs() && memory.frames < frames) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      const std::int64_t done = rows.count_in(root() / "o" / "hour");
      if (done < kFramesBeforeMeasuring) continue;
      memory.last_kb = resident_kb(child.pid());
      memory.most_kb = std::max(memory.most_kb, memory.last_kb);
      if (memory.first_kb == 0) first_frames_ = done, memory.first_kb = memory.last_kb;
      memory.frames = done;
    }
    EXPECT_EQ(child.finish(), 0) << content_of(root() / "stderr.txt");
    std::cout << format << ": resident " << memory.first_kb << " kB after " << first_frames_ << " frames, "
              << memory.most_kb << " kB at most, " << memory.last_kb << " kB after " << memory.frames << "\n";
    return memory;
  }

 private:
  TemporaryFolder folder_;
  std::int64_t first_frames_ = 0;
};

TEST_F(LongReplay, TenThousandFramesOfAnHourGrowMemoryByLessThanFiveMegabytes) {
  const Memory memory = replay("none", 10000);
  EXPECT_EQ(memory.frames, 10000);
  ASSERT_GT(memory.first_kb, 0);
  EXPECT_LT(memory.growth_kb(), kMostGrowthKb);
}

TEST_F(LongReplay, AThousandFramesAsPicturesGrowMemoryByLessThanFiveMegabytes) {
  const Memory memory = replay("png", 1500);
  EXPECT_EQ(memory.frames, 1500);
  ASSERT_GT(memory.first_kb, 0);
  EXPECT_LT(memory.growth_kb(), kMostGrowthKb);
}

}  // namespace
}  // namespace herr
