// Exit codes, the same for every command, and how an exception becomes one.
// Before: the command line or a command throws. After: the process ends with that
// code and one line on stderr.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace herr {

inline constexpr int kExitDone = 0;
inline constexpr int kExitRegression = 1;    // a check found what it looks for
inline constexpr int kExitUsage = 2;         // the command line is wrong
inline constexpr int kExitBadInput = 3;      // session, scene or image is wrong; trying again will not help
inline constexpr int kExitInconclusive = 4;  // a check cannot tell, or the two do not compare
inline constexpr int kExitPartial = 5;       // a result that lacks a part of its input
inline constexpr int kExitInternal = 70;     // a fault of this program or its installation
inline constexpr int kExitTemporary = 75;    // disk full, out of memory, port in use; trying again may help
inline constexpr int kExitSignalBase = 128;

// The command line asks for something that cannot be. what() is one line, "FLAG: problem; remedy".
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What this run needs is not there now (a port in use); trying again may help. what() is one line.
class TemporaryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The one of two codes that a run over several sessions ends with:
// done < partial < bad input < usage < temporary < internal < signal.
int worse_exit_code(int a, int b);

// The exit code of the exception in flight; call it inside a catch block. `message` gets its one line.
int exit_code_of_current_exception(std::string& message);

// Runs `body`; an exception becomes one "herr: ..." line on stderr and its exit code.
int run_guarded(const std::function<int()>& body);

}  // namespace herr
