#include "server/process/terminal.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string_view>

#include "sessions/files/system/descriptor.h"
#include "sessions/files/write_error.h"

namespace herr {
namespace {

// Returns the errno of the failure or 0.
int write_text(int descriptor, std::string_view text) {
  return write_all(descriptor, text.data(), text.size());
}

}  // namespace

void print_result(const std::string& text) {
  const int error = write_text(STDOUT_FILENO, text);
  if (error != 0 && error != EPIPE) throw WriteError("standard output", "write", error);
}

void print_message(const std::string& message) {
  std::string line = "herr: " + message;
  std::replace(line.begin(), line.end(), '\n', ' ');
  line += '\n';
  write_text(STDERR_FILENO, line);
}

bool stderr_is_terminal() {
  const char* terminal = std::getenv("TERM");
  const bool can_redraw = terminal != nullptr && std::string_view(terminal) != "dumb";
  return can_redraw && ::isatty(STDERR_FILENO) == 1;
}

void print_progress(const std::string& text) {
  write_text(STDERR_FILENO, text);
}

}  // namespace herr
