// checkpoint.json: where a replay stands and what it was made from, so that --resume can go on with it.
// Before: the replay loop, every so often and at its end. After: replay_session with --resume.
#pragma once

#include <filesystem>
#include <string>

#include "server/results/fingerprint.h"
#include "server/results/run_state.h"
#include "server/settings/frame_range.h"

namespace herr {

struct Checkpoint {
  Fingerprint fingerprint;
  RunState state;
};

std::string checkpoint_text(const Fingerprint& fingerprint, const RunState& state);
// Throws InputError that names the field.
Checkpoint read_checkpoint(const std::filesystem::path& file);
// A checkpoint of the run's own fingerprint that nobody edited lies in its range.
// Throws InputError for `file`.
void check_fits(const RunState& state, const FrameRange& range, const std::filesystem::path& file);

}  // namespace herr
