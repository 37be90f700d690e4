// `herr serve` as a child process over a small session, for tests of the whole program.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/paths.h"
#include "tests/server/http/http_client.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {

class ServeProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_profile(root() / "small.profile.json");
    write_small_session(root() / "walk", 0.25);
  }
  void TearDown() override {
    if (pid_ > 0) end(SIGKILL);
  }
  const std::filesystem::path& root() const { return folder_.path(); }

  void start(std::vector<std::string> arguments) {
    std::vector<std::string> line{test::program_path(), "serve", "walk"};
    const std::vector<std::pair<std::string, std::string>> usual{{"--profile", "small.profile.json"},
                                                                 {"--preset", "direct"},
                                                                 {"--polar", "128x64"},
                                                                 {"--threads", "2"}};
    for (const auto& [flag, value] : usual)
      if (std::find(arguments.begin(), arguments.end(), flag) == arguments.end())
        line.insert(line.end(), {flag, value});
    arguments.insert(arguments.begin(), line.begin(), line.end());
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const std::string out = (root() / "stdout.txt").string(), err = (root() / "stderr.txt").string();
    std::filesystem::remove(out);  // the address in it would be that of the run before
    pid_ = ::fork();
    if (pid_ != 0) return;
    if (::chdir(root().c_str()) != 0) ::_exit(126);
    ::dup2(::open(out.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644), STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  // The port that the program printed; 0 after ten seconds without one.
  int port() const {
    for (int i = 0; i < 1000; ++i) {
      const std::string text = content_of(root() / "stdout.txt");
      const std::string before = "http://127.0.0.1:";
      if (text.starts_with(before) && text.find('\n') != std::string::npos) {
        return std::atoi(text.c_str() + before.size());
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return 0;
  }
  static bool wait_for_frames(int port) {
    for (int i = 0; i < 1000; ++i) {
      if (get(port, "/readyz").status == 200) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  pid_t pid() const { return pid_; }
  // Exit code, or -signal.
  int end(int signal) {
    ::kill(pid_, signal);
    return wait();
  }
  int wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  TemporaryFolder folder_;
  pid_t pid_ = -1;
};

}  // namespace herr
