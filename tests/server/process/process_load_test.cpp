// CPU time and memory of this process against what the test does.
#include "server/process/process_load.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <memory>
#include <thread>
#include <vector>

#include "renderer/threads/cpu_use.h"

namespace herr {
namespace {

// This thread's own time on a core.
double thread_cpu_ms() {
  timespec used{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) * 1e3 + static_cast<double>(used.tv_nsec) * 1e-6;
}

double burn_ms(double wanted_ms) {
  const double start_ms = thread_cpu_ms();
  while (thread_cpu_ms() - start_ms < wanted_ms) {
  }
  return thread_cpu_ms() - start_ms;
}

std::int64_t resident_bytes() {
  std::int64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * ::sysconf(_SC_PAGESIZE);
}

TEST(ProcessLoadTest, CpuTimeIsThatOfAllThreads) {
  const auto start_ns = process_cpu_ns();
  ASSERT_TRUE(start_ns);
  double other_ms = 0;
  std::thread other([&] { other_ms = burn_ms(40); });
  const double own_ms = burn_ms(40);
  other.join();
  const double used_ms = static_cast<double>(*process_cpu_ns() - *start_ns) * 1e-6;
  EXPECT_GE(used_ms, own_ms + other_ms);
  // Beside the two loops there is a thread to start and to end: no more than a tenth of them.
  EXPECT_LE(used_ms, 1.1 * (own_ms + other_ms));
}

TEST(ProcessLoadTest, ASleepTakesNoCpuTime) {
  const auto start_ns = process_cpu_ns();
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_LE(static_cast<double>(*process_cpu_ns() - *start_ns) * 1e-6, 20);
}

TEST(ProcessLoadTest, ThePeakIsThatOfMemoryThatIsGoneAgain) {
  constexpr std::int64_t kBytes = 96 << 20;
  const std::int64_t before = resident_bytes();
  {
    std::vector<char> held(static_cast<std::size_t>(kBytes), 1);  // written to: resident
    EXPECT_GE(resident_bytes(), before + kBytes - (1 << 20));
  }
  const ProcessLoad load = process_load();
  ASSERT_TRUE(load.peak_resident_bytes);
  // The kernel counts pages of each core in batches: some hundred kilobytes may be missing.
  EXPECT_GE(*load.peak_resident_bytes, before + kBytes - (1 << 20));
  EXPECT_LT(resident_bytes(), before + kBytes / 2) << "it is gone";
}

TEST(ProcessLoadTest, CoresAreNoMoreThanThoseItMayRunOn) {
  cpu_set_t cores;
  ASSERT_EQ(::sched_getaffinity(0, sizeof cores, &cores), 0);
  EXPECT_GE(process_load().cores, 1);
  EXPECT_LE(process_load().cores, CPU_COUNT(&cores));
}

}  // namespace
}  // namespace herr
