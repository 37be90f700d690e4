// What a foreign recording seems to be: which preset fits, or which columns, units and axes, found from
// names, numbers, gravity, horizon and fixation under head motion; with how sure that is. Before: files.
// After: `herr convert --check` prints it and the command line that it recommends.
#pragma once

#include <string>
#include <vector>

#include "sessions/import/presets/choose_format.h"

namespace herr {

struct Proposal {
  enum class Certainty { certain, likely, cannot_tell };
  Certainty certainty = Certainty::cannot_tell;
  std::string preset, variant;         // empty: none fits, or none is needed
  std::string map_json;                // no preset: a column map; where it cannot tell, a draft or empty
  StillParts still;                    // what the recording lacks
  std::vector<std::string> reasons;    // whole sentences: what was found, what speaks for and against
  std::vector<std::string> questions;  // cannot_tell: what the user has to say, and how
};

// `request`: files, and what the user has said already. Reads the first rows of the files. Throws InputError
// when they cannot be read at all.
Proposal propose_format(const FormatRequest& request);

}  // namespace herr
