// A copy of the beginning of a session, without its camera feed, with every stamp moved by as much: what a
// recording would be that was made at another time. Before: a session's folder. After: stamps_relations.
#pragma once

#include <cstdint>
#include <filesystem>

#include "server/study/relations/recording_folder.h"
#include "sessions/format/pose.h"

namespace herr {

// Rows of each stream that are copied.
inline constexpr std::int64_t kShiftedRows = 20'000;

struct StampSpan {
  TimeNs first_ns = 0, last_ns = 0;
};
// Of all that would be copied. Throws InputError.
StampSpan stamps_of(const std::filesystem::path& session);

// Its folder lies among the system's temporary files and goes with the object.
class ShiftedSession {
 public:
  // Stamps plus `shift_ns` must be legal. Throws InputError and WriteError.
  ShiftedSession(const std::filesystem::path& session, TimeNs shift_ns);

  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  RecordingFolder folder_;
};

}  // namespace herr
