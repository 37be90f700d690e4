#include "server/process/stop_signal.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>

#include "server/process/exit_code.h"

namespace herr {
namespace {

std::atomic<int> g_stop_signal{0};
std::atomic<bool> g_stop_flag{false};
std::atomic<bool> g_end_at_once{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "the handler may only touch lock-free atomics");

extern "C" void on_stop_signal(int number) {
  int none = 0;
  const bool is_first = g_stop_signal.compare_exchange_strong(none, number);
  g_stop_flag = true;
  if (!is_first || g_end_at_once) ::_exit(kExitSignalBase + number);
}

}  // namespace

void install_signal_handling() {
  struct sigaction stop {};
  stop.sa_handler = on_stop_signal;
  sigemptyset(&stop.sa_mask);
  stop.sa_flags = SA_RESTART;
  sigaction(SIGINT, &stop, nullptr);
  sigaction(SIGTERM, &stop, nullptr);
  struct sigaction present {};
  if (sigaction(SIGHUP, nullptr, &present) == 0 && present.sa_handler != SIG_IGN) {
    sigaction(SIGHUP, &stop, nullptr);
  }
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigemptyset(&ignore.sa_mask);
  sigaction(SIGPIPE, &ignore, nullptr);
  sigaction(SIGXFSZ, &ignore, nullptr);
}

void end_at_once_on_signal() {
  g_end_at_once = true;
}

const std::atomic<bool>& stop_flag() {
  return g_stop_flag;
}

int stop_signal() {
  return g_stop_signal.load();
}

}  // namespace herr
