// The settings of a run as a list: those of its render, then how it reads the session and what
// it keeps. Before: the command line sets some by their flags. After: summary.json, fingerprints
// and file headers tell them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/setting.h"
#include "server/settings/replay_options.h"

namespace herr {

inline constexpr std::int64_t kMostFrames = 1'000'000'000;

// Of what a run depends on, the scene alone is none of them: it is an input, as the session is. The rows
// refer to `options`, which must outlive them and stay where it is.
std::vector<Setting> settings_of(ReplayOptions& options);

// The display profile by name or file, alone and with its scale: for commands that keep the two elsewhere.
// The rows refer to what is passed, likewise.
Setting profile_setting(std::string& profile);
std::vector<Setting> profile_settings(std::string& profile, double& scale);
// For people: "xr1", "xr1 at scale 0.5".
std::string profile_words(const std::string& name, double scale);

}  // namespace herr
