#include "server/process/terminal.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string_view>

#include "sessions/files/atomic_file.h"

namespace herr {
namespace {

// Writes everything; returns the errno of the failure or 0.
int write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(fd, text.data(), text.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

void print_result(const std::string& text) {
  const int error = write_all(STDOUT_FILENO, text);
  if (error != 0 && error != EPIPE) throw WriteError("standard output", "write", error);
}

void print_message(const std::string& message) {
  std::string line = "herr: " + message;
  std::replace(line.begin(), line.end(), '\n', ' ');
  line += '\n';
  write_all(STDERR_FILENO, line);
}

bool stderr_is_terminal() {
  const char* terminal = std::getenv("TERM");
  const bool can_redraw = terminal != nullptr && std::string_view(terminal) != "dumb";
  return can_redraw && ::isatty(STDERR_FILENO) == 1;
}

void print_progress(const std::string& text) {
  write_all(STDERR_FILENO, text);
}

}  // namespace herr
