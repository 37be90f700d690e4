// Puts a feed into the session: each picture once, each frame at its stamp. Before: open_feeds, import_rows.
// After: cam0/ and cam1/ of the session, and what the report says of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/convert/convert_feed.h"
#include "sessions/import/import_report.h"
#include "sessions/record/session_recorder.h"

namespace herr {

struct FeedReport {
  std::filesystem::path folder;
  std::int64_t pictures = 0, frames = 0;                                 // in the session
  std::string stamps;                                                    // where they come from, in words
  std::int64_t without_stamp = 0, repeated_stamps = 0, before_zero = 0;  // left out
  std::vector<std::string> assumed, remarks;                             // whole sentences

  std::int64_t left_out() const { return without_stamp + repeated_stamps + before_zero; }
};

// Stamps move by --camera-offset-ms, and with those of the rows. Calls `pass_by` before each frame. Throws
// InputError where no picture was taken while the head was recorded.
FeedReport write_feed(const FeedOptions& options, std::size_t camera, const Feed& feed,
                      const ImportReport& rows, SessionRecorder& recorder, void (*pass_by)());

}  // namespace herr
