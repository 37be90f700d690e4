// A picture of a look to the bytes of its file, and the exposure that it is shown with. Before: look_picture.
// After: look_command writes them.
#pragma once

#include <cstdint>
#include <vector>

#include "server/look/look_files.h"
#include "server/look/look_picture.h"

namespace herr {

// That of the options, else that of the scene, else automatic: by the model's pixels alone (metered_ev). In
// the studio light is known, and a dark surface stays dark: the exposure is 0, and below it only where more
// than 5 % of the model would be brighter than white.
Exposure look_exposure(const LookOptions& options, const Scene& scene, bool studio,
                       const ViewportImage& model);

// PNG with alpha where there is no background. EXR keeps scene values and has the exposure as metadata.
// Throws std::runtime_error when an encoder refuses.
std::vector<std::uint8_t> encoded_look(const LookOptions& options, LookRenderer& renderer,
                                       const LookCamera& camera, const ViewportImage& picture,
                                       PictureFormat format);

}  // namespace herr
