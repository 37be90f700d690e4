// The program as a child process whose output waits until the test reads it, so that a signal can be sent at
// a known place: the child stands still at its first result.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace herr {

class ChildProgram {
 public:
  // Starts `arguments` ([0] is the program) in `folder`; stderr goes to folder/stderr.txt.
  ChildProgram(const std::filesystem::path& folder, std::vector<std::string> arguments)
      : ChildProgram(folder, [&arguments] {
          std::vector<char*> words;
          for (std::string& word : arguments) words.push_back(word.data());
          words.push_back(nullptr);
          ::execv(words[0], words.data());
          return 99;
        }) {}
  // A process of its own for `body`, whose answer is the exit code. A copy of the test need not load what the
  // test has loaded. The test must have no threads in work.
  ChildProgram(const std::filesystem::path& folder, const std::function<int()>& body) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    fill(ends[1]);
    const std::string messages = (folder / "stderr.txt").string();
    pid_ = ::fork();
    if (pid_ == 0) {
      const int messages_fd = ::open(messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      ::dup2(ends[1], STDOUT_FILENO);
      ::dup2(messages_fd, STDERR_FILENO);
      ::_exit(::chdir(folder.c_str()) == 0 ? body() : 99);
    }
    ::close(ends[1]);
    output_ = ends[0];
  }
  ~ChildProgram() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    if (output_ >= 0) ::close(output_);
  }
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  pid_t pid() const { return pid_; }
  void send(int signal) const { ::kill(pid_, signal); }
  bool runs() {
    if (pid_ > 0 && ::waitpid(pid_, &status_, WNOHANG) == pid_) pid_ = -1;
    return pid_ > 0;
  }
  // Its handler of `signal` is in place.
  bool catches(int signal) const {
    std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
    for (std::string row; std::getline(status, row);) {
      if (!row.starts_with("SigCgt:")) continue;
      return ((std::stoull(row.substr(7), nullptr, 16) >> (signal - 1)) & 1u) != 0;
    }
    return false;
  }
  // Reads the output to its end; returns the exit code, or -1 where a signal killed the child.
  int finish() {
    char buffer[4096];
    for (ssize_t n = 0; (n = ::read(output_, buffer, sizeof buffer)) > 0;)
      out_.append(buffer, static_cast<std::size_t>(n));
    if (pid_ > 0) ::waitpid(pid_, &status_, 0);
    pid_ = -1;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }
  // What the child printed; complete after finish().
  std::string out() const {
    const std::size_t start = out_.find_first_not_of(kFiller);
    return start == std::string::npos ? "" : out_.substr(start);
  }

 private:
  static constexpr char kFiller = '\x01';

  // A full pipe stops the first write of the child.
  void fill(int end) const {
    const std::string bytes(4096, kFiller);
    ::fcntl(end, F_SETPIPE_SZ, 4096);
    ::fcntl(end, F_SETFL, O_NONBLOCK);
    while (::write(end, bytes.data(), bytes.size()) > 0) {
    }
    ::fcntl(end, F_SETFL, 0);
  }

  pid_t pid_ = -1;
  int output_ = -1, status_ = 0;
  std::string out_;
};

}  // namespace herr
