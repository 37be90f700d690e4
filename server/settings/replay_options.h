// What `herr replay` is asked to do; one struct, each field with its default and a sentence. Ranges, flags
// and names of settings stand in run_settings.cpp. Before: the command line fills it. After: replay_command,
// replay_session.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/render_settings.h"
#include "server/quality/quality_policy.h"
#include "server/settings/picture_formats.h"
#include "server/settings/replay_clock.h"
#include "sessions/streams/session_options.h"

namespace herr {

enum class SheetChoice { none, all, middle, one };

struct ReplayOptions {
  std::vector<std::filesystem::path> sessions;     // at least one folder
  std::string scene;                               // empty: the scene that the session names
  std::vector<std::filesystem::path> asset_roots;  // folders below which a scene document finds models, too
  std::filesystem::path out = "out";               // each session gets a folder of its name in it
  PictureFormats formats = PictureFormat::png;     // of the pictures that are kept
  std::string profile;                             // built-in name or file; empty: the profile of the session
  double profile_scale = 1;                        // pixels of its viewports along each axis are times this
  std::string view;                                // file of a camera outside the headset; empty: none
  RenderSettings render;
  SessionOptions session;
  ReplayClock clock = ReplayClock::virtual_time;
  QualityPolicy policy;  // how the quality of each frame is chosen
  std::optional<int>
      narrowest_width;  // polar width per eye that policies keep; empty: an eighth of the full one
  std::optional<int>
      lowest_height;  // polar height that the policy deadline keeps; empty: a quarter of the full one
  // realtime: the display period; deadline: the time of a frame. Empty: the period of the profile.
  std::optional<double> target_ms;
  double start_s = 0;                  // first frame at or after this time of the session
  std::optional<double> duration_s;    // frames before start + duration
  std::optional<std::int64_t> frames;  // at most this many frames
  SheetChoice sheet = SheetChoice::middle;
  std::int64_t sheet_frame = 0;  // for SheetChoice::one
  bool overwrite = false;        // replace the results in a folder that is not empty
  bool resume = false;           // go on with an interrupted replay in that folder
  bool json = false;             // results on stdout as JSON instead of a table
};

const char* name_of(SamplingMode mode);

}  // namespace herr
