// The file of --view: where a camera outside the headset stands and what its picture is like. Strict JSON:
// {"name", "space": "scene|session", "position_m": [x, y, z], "look_at_m": [x, y, z] with "up": [x, y, z], or
// "orientation_xyzw": [qx, qy, qz, qw], "fov_deg", "width_px", "height_px", "samples", "see_through_colour",
// "overlay", "frusta_m"}. Before: the flag. After: open_session hands it to the renderer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/outside_view.h"

namespace herr {

// Rays of a picture, all together: 8 bytes of memory each.
inline constexpr std::int64_t kMostOutsideRays = std::int64_t{1} << 27;

// Throws InputError that names the field. Appends a line to `warnings` where the quaternion looks w-first.
OutsideView load_view_file(const std::filesystem::path& file, std::vector<std::string>& warnings);

// What of a view decides its picture, each number in full: for fingerprints.
std::string view_text(const OutsideView& view);

}  // namespace herr
