// The pictures of `herr convert`: which, when they were taken, through which lens. Before: feed_sources.
// After: feed_writer puts them into the session.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "server/convert/convert_options.h"
#include "server/convert/feed_sources.h"
#include "sessions/format/session_header.h"
#include "sessions/import/cameras/camera_pictures.h"
#include "sessions/import/cameras/picture_stamps.h"
#include "sessions/import/presets/choose_format.h"

namespace herr {

struct Feed {
  std::filesystem::path folder;
  CameraPictures pictures;
  std::optional<StampedPictures> stamped;  // none: at a rate, on the user's word
  SessionHeader::Camera camera;
  std::vector<std::string> assumed, remarks;  // whole sentences
};

// A camera that a recorder's folder holds is left out with a remark where its stamps or its lens are unknown.
// `files`: the recording's own, which are no tables of stamps unless their format says so. Throws InputError.
std::vector<Feed> open_feeds(const FeedOptions& options, const std::vector<FeedSource>& sources,
                             const ChosenFormat& format, const RecordingFiles& files,
                             std::vector<std::string>& remarks);

}  // namespace herr
