// Reads session.json, format version 1 (the schema is in this folder's README.md).
// Before: a file. After: Session::open, which checks the streams against what the header says.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/session.h"

namespace herr {

inline constexpr int kSessionFormatVersion = 1;
// Later stamps are refused, so that the difference of any two fits into 64 bits (4e18 ns = 126 years).
inline constexpr TimeNs kLastStampNs = 4'000'000'000'000'000'000;

struct ParsedSessionHeader {
  SessionHeader header;
  std::optional<TimeNs> start_ns, end_ns;  // narrow the span that can be replayed
  std::vector<InputError> warnings;        // legal but unlikely values, e.g. eyes 10 m apart
};

// Throws InputError that names the field.
ParsedSessionHeader read_session_header(const std::filesystem::path& session_json);

}  // namespace herr
