// The pictures of `herr convert`: which, when they were taken, through which lens; and their way into the
// session. Before: FeedOptions, the folder that a recorder left. After: cam0/ and cam1/ of the session.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/convert/convert_options.h"
#include "sessions/format/session_header.h"
#include "sessions/import/cameras/camera_pictures.h"
#include "sessions/import/cameras/picture_stamps.h"
#include "sessions/import/import_report.h"
#include "sessions/import/presets/choose_format.h"
#include "sessions/import/presets/recording_folder.h"
#include "sessions/record/session_recorder.h"

namespace herr {

struct Feed {
  CameraPictures pictures;
  std::optional<StampedPictures> stamped;  // none: at a rate, on the user's word
  SessionHeader::Camera camera;
  std::vector<std::string> remarks;  // about the lens
};

struct FeedReport {
  std::int64_t pictures = 0, frames = 0;
  std::string stamps;         // where they come from, in words
  std::int64_t left_out = 0;  // pictures without a stamp, or out of order
  std::vector<std::string> remarks;
};

// A flag that would change nothing is a mistake of whoever gave it. Throws UsageError.
void check_feed_options(const FeedOptions& options);

// None, one or two. Pictures that a recorder's folder holds are left out with a remark where their lens or
// their stamps are unknown. Throws InputError, UsageError.
std::vector<Feed> open_feeds(const FeedOptions& options, const std::vector<FoundCamera>& found,
                             const ChosenFormat& format, std::vector<std::string>& remarks);

// Copies each picture once; a loop names them again. Calls `pass_by` before each row.
FeedReport write_feed(const FeedOptions& options, std::size_t camera, const Feed& feed,
                      const ImportReport& rows, SessionRecorder& recorder, void (*pass_by)());

}  // namespace herr
