// What the pictures of a replay depend on: its settings, and the content of every file that it reads. Two
// runs of one fingerprint make the same bytes. Before: open_session. After: checkpoint.json.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scenes/model/scene.h"
#include "server/results/session_report.h"
#include "server/settings/replay_options.h"

namespace herr {

struct Fingerprint {
  using Entries = std::vector<std::pair<std::string, std::string>>;
  Entries settings;  // flag, or name where there is none; value
  Entries inputs;    // file, its size and CRC-32; camera images by PictureIdentity
};

// What makes a camera image the same one: too many to read. The time of change tells one folder from itself
// later; a copy elsewhere has others.
enum class PictureIdentity { size_and_time, size };

// Reads every input once, save the camera images. Throws InputError.
Fingerprint fingerprint_of(const SessionReport& report, const ReplayOptions& options, const Scene& scene,
                           PictureIdentity identity = PictureIdentity::size_and_time);

struct FingerprintDifference {
  std::string name;       // of the entry
  bool of_input = false;  // or of a setting
  std::string text;       // "--light-samples was 64, is 1"
};
// Settings first, each in the order of `now`, then inputs that are gone. A setting that the earlier program
// did not know had its default.
std::vector<FingerprintDifference> differences(const Fingerprint& earlier, const Fingerprint& now);
// The text of the first one; empty when there is none.
std::string difference(const Fingerprint& earlier, const Fingerprint& now);

// An entry of settings as the flag that would ask for it: "--polar 1576x768", "--no-camera", "--no-probes";
// "without --gaze-marker" where no flag asks for it.
std::string flags_of(const std::pair<std::string, std::string>& entry);

// Each setting that shapes pictures or says which files a run leaves, by its flag, as fingerprints tell it.
Fingerprint::Entries setting_entries(ReplayOptions options);

}  // namespace herr
