// Long logs through `herr convert`: memory does not grow with them, and time stays that of reading them.
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

#include "sessions/text/fixed_text.h"
#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

struct Use {
  int exit_code = -1;
  double cpu_s = 0;
  long peak_kb = 0;  // resident
};

// 4x4 matrices by rows, 1 kHz, a head that looks about while it walks in circles.
void write_matrices(const std::filesystem::path& file, int rows) {
  std::ofstream out(file);
  for (int i = 0; i < rows; ++i) {
    const double yaw = 0.5 * std::sin(i * 1e-3), x = 2 * std::sin(i * 1e-4), z = 2 * std::cos(i * 1.3e-4);
    const double matrix[16] = {std::cos(yaw),  0, std::sin(yaw), x, 0, 1, 0, 1.6,
                               -std::sin(yaw), 0, std::cos(yaw), z, 0, 0, 0, 1};
    std::string row = std::to_string(1000 + i / 1000) + "." + std::to_string(1000 + i % 1000).substr(1);
    for (const double value : matrix) row += " " + fixed_text(value, 7);
    out << row << "\n";
  }
  ASSERT_TRUE(out.good());
}

class LongConvert : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(root() / "map.json") << R"({"format_version": 1, "name": "matrices", "head": [{
      "separator": "spaces", "header": false, "time": {"column": 1, "unit": "s"},
      "orientation": {"matrix_4x4": [2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17], "major": "row"},
      "world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "back"]}]})";
  }
  const std::filesystem::path& root() const { return folder_.path(); }

  Use convert(const std::string& file, const std::string& out) const {
    const std::string program = test::program_path();
    const pid_t child = ::fork();
    if (child == 0) {
      if (::chdir(root().c_str()) != 0 || std::freopen("/dev/null", "w", stdout) == nullptr) ::_exit(98);
      ::execl(program.c_str(), "herr", "convert", file.c_str(), out.c_str(), "--map", "map.json", nullptr);
      ::_exit(99);
    }
    int status = 0;
    rusage used{};
    EXPECT_EQ(::wait4(child, &status, 0, &used), child);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, seconds(used.ru_utime) + seconds(used.ru_stime),
            used.ru_maxrss};
  }
  TemporaryFolder folder_;
};

TEST_F(LongConvert, NeedsNoMoreMemoryForTenMinutesThanForTwentyRows) {
  write_matrices(root() / "short.txt", 20);
  write_matrices(root() / "long.txt", 600'000);
  const Use few = convert("short.txt", "few"), many = convert("long.txt", "many");
  ASSERT_EQ(few.exit_code, 0);
  ASSERT_EQ(many.exit_code, 0);
  const double mb = static_cast<double>(std::filesystem::file_size(root() / "long.txt")) * 1e-6;
  std::cout << mb / (many.cpu_s - few.cpu_s) << " MB per CPU second, " << many.peak_kb - few.peak_kb
            << " kB more than for 20 rows\n";
  EXPECT_LE(many.peak_kb - few.peak_kb, 10'000);
  EXPECT_GE(mb / (many.cpu_s - few.cpu_s), 25);
}

}  // namespace
}  // namespace herr
