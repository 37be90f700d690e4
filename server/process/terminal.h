// What the program says: results on stdout, messages and progress on stderr. The only
// file that writes to either.
#pragma once

#include <string>

namespace herr {

// Writes `text` to stdout as it is. A reader that has gone away (EPIPE) ends the output quietly; any other
// failure throws WriteError.
void print_result(const std::string& text);

// One line "herr: MESSAGE" on stderr. Line breaks inside the message become spaces. A closed stderr is not an
// error: there is nobody left to tell.
void print_message(const std::string& message);

// True when stderr is a terminal that can redraw a line.
bool stderr_is_terminal();

// Back to the start of a terminal's line, and clears it.
inline constexpr const char* kClearLine = "\r\033[K";

// Writes to stderr as it is (progress).
void print_progress(const std::string& text);

}  // namespace herr
