// What `herr convert` is asked to do.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace herr {

struct ConvertOptions {
  std::filesystem::path head;                 // the recording, or its trajectory
  std::filesystem::path out;                  // the session's folder
  std::optional<std::filesystem::path> gaze;  // a file of its own
  std::string preset;                         // a built-in column map
  std::filesystem::path map;                  // or a column map of the user's
  bool show_map = false;                      // print the map and do nothing else

  std::filesystem::path camera;              // folder of pictures; empty: no feed
  double camera_hz = 15;                     // how fast they follow each other
  bool camera_loop = false;                  // begin again at the end, as long as the poses last
  double camera_hfov_deg = 0;                // width of the view of a pinhole; 0: not given
  std::filesystem::path camera_calibration;  // Project Aria's JSON instead of --camera-hfov
  std::string camera_label = "camera-rgb";   // which camera of the calibration

  std::string profile = "xr1";  // display profile, built in or a file
  std::string scene;            // written into session.json, relative to OUT
  std::string licence;          // of the recording
  bool overwrite = false, keep_going = false, json = false;
};

}  // namespace herr
