// `herr serve` under load: well-behaved clients at full speed beside half-open and dripping ones, and frames
// while somebody looks once a second. Sends to 127.0.0.1 alone, for a bounded time.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <vector>

#include "tests/server/program/serve_program.h"

namespace herr {
namespace {

using std::chrono::duration;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr int kFullSpeed = 16, kHalfOpen = 32, kDripping = 32;
constexpr seconds kLoadTime{20};

std::int64_t resident_kb(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string row; std::getline(status, row);)
    if (row.starts_with("VmRSS:")) return std::stoll(row.substr(6));
  return 0;
}

// Clients that never finish a request, again and again: they hold their connection until the server ends it.
class RudeClients {
 public:
  explicit RudeClients(int port) {
    for (int i = 0; i < kHalfOpen + kDripping; ++i)
      threads_.emplace_back([this, port, drips = i >= kHalfOpen] { annoy(port, drips); });
  }
  ~RudeClients() {
    stop_ = true;
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  void annoy(int port, bool drips) {
    const std::string request = request_text("/v1/status");
    while (!stop_) {
      RawClient client(port);
      // 2 s of silence, or a byte every 50 ms: both longer than a head may take.
      for (std::size_t i = 0; i < 40 && !stop_; ++i) {
        if (drips && !client.send(request.substr(i % request.size(), 1))) break;
        std::this_thread::sleep_for(milliseconds(50));
      }
    }
  }
  std::atomic<bool> stop_{false};
  std::vector<std::thread> threads_;
};

struct Crowd {
  std::int64_t answered = 0, failed = 0;
};

// wrk, where it is installed: 16 connections as fast as they go.
bool has_wrk() {
  return std::system("command -v wrk >/dev/null 2>&1") == 0;
}
Crowd run_wrk(int port) {
  const std::string line = "wrk -t1 -c" + std::to_string(kFullSpeed) + " -d" +
                           std::to_string(kLoadTime.count()) +
                           "s --timeout 10s http://127.0.0.1:" + std::to_string(port) + "/v1/status 2>&1";
  Crowd crowd;
  FILE* pipe = ::popen(line.c_str(), "r");
  char row[512];
  while (pipe != nullptr && std::fgets(row, sizeof row, pipe) != nullptr) {
    const std::string text(row);
    std::cout << "  wrk: " << text;
    const std::size_t requests = text.find(" requests in ");
    if (requests != std::string::npos) crowd.answered = std::atoll(text.c_str());
    // "Socket errors: connect 0, read 0, write 0, timeout 0", "Non-2xx or 3xx responses: 5"
    const std::size_t numbers = text.find("errors: connect ");
    long long connect = 0, read = 0, write = 0, timeout = 0;
    if (numbers != std::string::npos &&
        std::sscanf(text.c_str() + numbers, "errors: connect %lld, read %lld, write %lld, timeout %lld",
                    &connect, &read, &write, &timeout) == 4)
      crowd.failed += connect + read + write + timeout;
    if (text.find("Non-2xx") != std::string::npos) crowd.failed += std::atoll(text.c_str() + text.rfind(' '));
  }
  if (pipe != nullptr) ::pclose(pipe);
  return crowd;
}

// The same by threads of this test.
Crowd run_threads(int port) {
  std::atomic<std::int64_t> answered{0}, failed{0};
  const auto until = steady_clock::now() + kLoadTime;
  std::vector<std::thread> threads;
  for (int i = 0; i < kFullSpeed; ++i) {
    threads.emplace_back([&] {
      while (steady_clock::now() < until) ++(get(port, "/v1/status").status == 200 ? answered : failed);
    });
  }
  for (std::thread& thread : threads) thread.join();
  return {answered, failed};
}

double p95_of_window(int port) {
  return nlohmann::json::parse(get(port, "/v1/latency").body)["window"]["frame"]["p95"].get<double>();
}

TEST_F(ServeProgram, WellBehavedClientsAreAnsweredBesideEveryOther) {
  start({"--port", "0"});
  const int port = this->port();
  ASSERT_TRUE(port != 0 && wait_for_frames(port));
  std::vector<double> livez_ms;
  std::int64_t livez_failed = 0, settled_kb = 0;
  Crowd crowd;
  {
    const RudeClients rude(port);
    std::thread pollers([&] { crowd = has_wrk() ? run_wrk(port) : run_threads(port); });
    const auto started = steady_clock::now();
    while (steady_clock::now() - started < kLoadTime) {
      const auto asked = steady_clock::now();
      const Reply reply = get(port, "/livez");
      livez_ms.push_back(duration<double, std::milli>(steady_clock::now() - asked).count());
      if (reply.status != 200) {
        ++livez_failed;
        std::cout << "  /livez failed: status " << reply.status << " after " << livez_ms.back() << " ms, "
                  << duration<double>(asked - started).count() << " s after the start\n";
      }
      // The last ten seconds of frames fill their ring first.
      if (settled_kb == 0 && steady_clock::now() - started > seconds(12)) settled_kb = resident_kb(pid());
      std::this_thread::sleep_for(milliseconds(20));
    }
    pollers.join();
  }
  const std::int64_t end_kb = resident_kb(pid());
  std::sort(livez_ms.begin(), livez_ms.end());
  const double p99_ms = livez_ms[livez_ms.size() * 99 / 100];
  std::cout << "  " << crowd.answered << " answers, " << crowd.failed
            << " failed; /livez: " << livez_ms.size() << " times, " << livez_failed << " failed, median "
            << livez_ms[livez_ms.size() / 2] << " ms, p99 " << p99_ms << " ms; resident " << settled_kb
            << " kB after 12 s, " << end_kb << " kB at the end\n";
  EXPECT_GT(crowd.answered, 1000);
  EXPECT_EQ(crowd.failed, 0);
  EXPECT_EQ(livez_failed, 0);
  EXPECT_LE(p99_ms, 100.0);
  EXPECT_LE(end_kb - settled_kb, 2048) << "kB: flat but for pages of the heap";
  EXPECT_EQ(end(SIGTERM), 0);
}

// Frames of windows of 10 s, undisturbed and polled once a second in turn. Each side is judged by its best
// window: the machine's other work only ever slows frames. The best of two windows a side were seen to differ
// by 16 % where nothing disturbs them, the best of six by 1 to 5 %.
TEST_F(ServeProgram, FramesDoNotFeelSomebodyWhoLooksOnceASecond) {
  // 5 % of a frame's time is less than what a machine that others share adds by itself.
  if (std::getenv("CI") != nullptr) GTEST_SKIP() << "measures times: run it on a quiet machine";
  start({"--port", "0", "--profile", "xr1-half", "--preset", "direct", "--polar", "512x256", "--target-ms",
         "200"});
  const int port = this->port();
  ASSERT_TRUE(port != 0 && wait_for_frames(port));
  std::this_thread::sleep_for(seconds(3));
  double best[2] = {1e9, 1e9};
  for (int window = 0; window < 12; ++window) {
    const int polled = (window + 1) / 2 % 2;  // 0 1 1 0: a machine that slows down slows both
    for (int second = 0; second < 10; ++second) {
      std::this_thread::sleep_for(seconds(1));
      if (polled == 0) continue;
      for (const char* path : {"/v1/status", "/v1/latency", "/v1/frames", "/metrics"}) {
        EXPECT_EQ(get(port, path).status, 200);
      }
    }
    best[polled] = std::min(best[polled], p95_of_window(port));
  }
  std::cout << "  frame p95: undisturbed " << best[0] << " ms, polled " << best[1] << " ms\n";
  EXPECT_LE(best[1], 1.05 * best[0]);
  EXPECT_EQ(end(SIGTERM), 0);
}

}  // namespace
}  // namespace herr
