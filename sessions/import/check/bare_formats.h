// Formats whose files name no columns fit many tables by accident: whether a table is one of theirs.
// Before: choose_format, sniffed_table. After: proposal.
#pragma once

#include <optional>
#include <string>

#include "sessions/import/presets/choose_format.h"

namespace herr {

// False: the columns that the format counts are there, and hold something else or more than it says.
bool is_its_own_file(const ChosenFormat& chosen, const FormatRequest& request);

// Of a format that fixes no axes (a TUM trajectory), what has to be said before those taken are sure; empty
// where the data show them.
std::optional<std::string> open_axes(const ChosenFormat& chosen, const FormatRequest& request);

}  // namespace herr
