// What stands beside a frame counts by the CPU time that the test itself spends.
#include "server/frames/work_beside.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <thread>

namespace herr {
namespace {

void burn_ms(double wanted_ms) {
  const auto start_ns = thread_cpu_ns();
  ASSERT_TRUE(start_ns);
  while (static_cast<double>(*thread_cpu_ns() - *start_ns) * 1e-6 < wanted_ms) {
  }
}

TEST(WorkBesideTest, SamplingIsTheCpuTimeOfItsThreadAlone) {
  WorkBeside beside;
  std::thread other([] { burn_ms(60); });
  beside.begin_sampling();
  burn_ms(10);
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  beside.end_sampling();
  other.join();
  // Neither the sleep nor the other thread, 60 ms each.
  EXPECT_GE(beside.cpu_ms(std::nullopt, 2), 10);
  EXPECT_LE(beside.cpu_ms(std::nullopt, 2), 30);
}

TEST(WorkBesideTest, RenderingBeyondTheFrameIsSpreadOverTheThreads) {
  WorkBeside beside;
  beside.begin_rendering();
  burn_ms(40);
  beside.end_rendering();
  // 10 of them were the frame's own: 30 over three threads. At most half as much for the test itself.
  EXPECT_GE(beside.cpu_ms(10.0, 3), 10);
  EXPECT_LE(beside.cpu_ms(10.0, 3), 15);
  EXPECT_EQ(beside.cpu_ms(1e6, 3), 0) << "never below 0";
  EXPECT_EQ(beside.cpu_ms(std::nullopt, 3), 0) << "not known: the least";
}

}  // namespace
}  // namespace herr
