// Stamped pictures in the order of their stamps, each once; what had to be left out is counted and said.
// Before: one picture and stamp after the other. After: picture_stamps hands them on.
#pragma once

#include <string>

#include "sessions/import/cameras/picture_stamps.h"

namespace herr {

// Sorts, drops all but the first of equal stamps, counts pictures that have none, adds the remarks.
// `lacks`: of a picture without a stamp: "have no stamp in frames.csv". Throws InputError when none is left.
void put_in_order(StampedPictures& stamped, const CameraPictures& pictures, const std::string& lacks);

// Whole seconds of several pictures a second are no stamps: throws InputError that says where they are from
// and what else there is. `seconds_only`: of each picture, whether its stamp has no fraction.
void refuse_whole_seconds(const StampedPictures& stamped, const std::vector<bool>& seconds_only,
                          const std::string& where);

std::filesystem::path folder_of(const CameraPictures& pictures);

}  // namespace herr
