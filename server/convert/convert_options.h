// What `herr convert` is asked to do.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sessions/import/import_rows.h"

namespace herr {

// The camera feed: at most two cameras, the left and the right eye's.
struct FeedOptions {
  std::vector<std::filesystem::path> pictures;     // folders; empty: those of the recording's folder, if any
  std::vector<std::filesystem::path> stamps;       // tables, one a camera, or one for both
  std::vector<std::filesystem::path> calibration;  // one a camera, or one for both
  std::vector<std::string> label;                  // which camera of the calibration, one a camera
  std::vector<std::string> names;                  // patterns of stamps in the pictures' names, likewise
  std::optional<int> zone_minutes;                 // of dates in tables, names and EXIF
  std::optional<double> hz;                        // no stamps were recorded: so many pictures a second
  bool loop = false;                               // hz: begin again at the end, as long as the poses last
  double offset_ms = 0;                            // added to every stamp of a picture
  double hfov_deg = 0;                             // width of the view of a pinhole; 0: not given
  std::optional<double> distance_m;                // of the feed's sphere about the displayed eye
  // The user said where stamps or lenses come from.
  bool any_stamps_or_lens() const {
    return !stamps.empty() || !calibration.empty() || !label.empty() || !names.empty() || hz || hfov_deg != 0;
  }
  bool none = false;  // leave the pictures of the recording's folder out
};

struct ConvertOptions {
  std::vector<std::string> arguments;         // as they were typed after `herr convert`
  std::filesystem::path head;                 // the recording: a file, or a recorder's folder
  std::filesystem::path out;                  // the session's folder
  std::optional<std::filesystem::path> gaze;  // a file of its own
  std::string preset;                         // a built-in format; empty and no map: recognised
  std::string variant;                        // of siblings
  std::filesystem::path map;                  // a column map of the user's
  bool show_map = false;                      // print the preset's map and do nothing else
  bool check = false;                         // say what the recording seems to be and do nothing else
  std::filesystem::path write_map;            // check: where a proposed map goes
  StillParts still;
  bool sort = false;  // put rows that come late where they belong

  FeedOptions feed;
  std::string profile = "xr1";  // display profile, built in or a file
  std::string scene;            // written into session.json, relative to OUT
  std::string licence;          // of the recording
  bool overwrite = false, keep_going = false, json = false;
};

}  // namespace herr
