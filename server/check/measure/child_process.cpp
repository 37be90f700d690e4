#include "server/check/measure/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>
#include <utility>

#include "server/process/steady_time.h"
#include "server/process/stop_signal.h"
#include "sessions/files/input_error.h"

extern char** environ;  // POSIX

namespace herr {
namespace {

constexpr int kPatience_ms = 50;  // between two looks at the clock and at stop_signal()

[[noreturn]] void throw_errno(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) throw_errno(errno, "cannot make a pipe");
  }
  ~Pipe() {
    close(ends_[0]);
    close(ends_[1]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reading_end() const { return ends_[0]; }
  int writing_end() const { return ends_[1]; }
  void close_writing_end() { close(ends_[1]); }
  // False at the end of what the other side writes.
  bool read_into(std::string& text) {
    std::array<char, 1 << 16> block;
    const ssize_t got = ::read(ends_[0], block.data(), block.size());
    if (got > 0) text.append(block.data(), static_cast<std::size_t>(got));
    return got > 0 || (got < 0 && errno == EINTR);
  }

 private:
  static void close(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
  std::array<int, 2> ends_{-1, -1};
};

// A child that does not outlive its owner.
class Child {
 public:
  Child(const std::string& program, const std::vector<std::string>& arguments, const Pipe& out,
        const Pipe& err) {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, out.writing_end(), STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, err.writing_end(), STDERR_FILENO);
    const int error = ::posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw_errno(error, "cannot run " + printable(program));
  }
  ~Child() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int wait() {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : kExitSignalBase + WTERMSIG(status);
  }

 private:
  pid_t pid_ = -1;
};

}  // namespace

ProcessOutcome run_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                           double most_seconds) {
  Pipe out, err;
  Child child(program.string(), arguments, out, err);
  out.close_writing_end();
  err.close_writing_end();
  const TimeNs end_ns = steady_now_ns() + static_cast<TimeNs>(most_seconds * 1e9);
  ProcessOutcome outcome;
  std::array<pollfd, 2> ends{{{out.reading_end(), POLLIN, 0}, {err.reading_end(), POLLIN, 0}}};
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    if (const int signal = stop_signal(); signal != 0) {
      outcome.exit_code = kExitSignalBase + signal;
      return outcome;
    }
    if (steady_now_ns() > end_ns) {
      throw TookTooLong(printable(program.string()) + " did not end within " +
                        std::to_string(static_cast<int>(most_seconds)) + " s; give fewer --frames");
    }
    if (::poll(ends.data(), ends.size(), kPatience_ms) <= 0) continue;
    if (ends[0].revents != 0 && !out.read_into(outcome.out)) ends[0].fd = -1;
    if (ends[1].revents != 0 && !err.read_into(outcome.err)) ends[1].fd = -1;
  }
  outcome.exit_code = child.wait();
  return outcome;
}

}  // namespace herr
