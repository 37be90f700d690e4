// The cameras of a conversion, each as the command line and the recorder's folder describe it together.
// Before: FeedOptions, find_recording. After: convert_feed opens them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/convert/convert_options.h"
#include "sessions/import/presets/recording_folder.h"

namespace herr {

struct FeedSource {
  std::filesystem::path pictures;             // a folder
  std::filesystem::path stamps, calibration;  // empty: not named
  std::string label, names;
  bool of_folder = false;  // found in the recorder's folder, not named by the user
};

// Flags that contradict each other. Throws UsageError.
void check_feed_options(const FeedOptions& options);

// None, one or two. A flag that would change nothing is a mistake of whoever gave it: throws UsageError.
std::vector<FeedSource> feed_sources(const FeedOptions& options, const std::vector<FoundCamera>& found);

}  // namespace herr
