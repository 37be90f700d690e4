// The displays of a headset: any list of planar viewports, each fixed to one eye, and the refresh rate.
// JSON: {"name", "display_hz", "viewports": [{"name", "eye": "left|right", "kind": "context|focus",
// "width_px", "height_px", "left_deg", "right_deg", "down_deg", "up_deg", "edge_blend_deg"}]}; units and
// ranges of each key: sessions/README.md.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace herr {

enum class Eye : int { left = 0, right = 1 };
inline constexpr std::array<Eye, 2> kEyes{Eye::left, Eye::right};

// A pinhole image plane in eye space (eye looks along -Z, +Y up). Pixel (0, 0) is at the upper left.
struct Viewport {
  std::string name;  // unique, e.g. "left_context"; becomes part of file names: [a-z0-9_]{1,40}
  Eye eye = Eye::left;
  bool focus = false;  // a focus viewport is blended over the context viewport of its eye by the display
  int width_px = 0;    // 1 ... 16384
  int height_px = 0;
  // Half-angles from the forward axis to each border as tangents; right > left, up > down, |tan| <= tan(89.5
  // deg).
  double tan_left = 0, tan_right = 0, tan_down = 0, tan_up = 0;
  double edge_blend_deg = 0;  // of a focus viewport: over so much at its borders the headset blends it in

  bool operator==(const Viewport&) const = default;
};

// Pixels per degree where the viewport has the most: at its farthest corner, outwards from its middle.
double finest_pixels_per_degree(const Viewport& viewport);

struct DisplayProfile {
  std::string name;
  double display_hz = 60;           // 1 ... 1000
  std::vector<Viewport> viewports;  // 1 ... 64

  bool operator==(const DisplayProfile&) const = default;
};

// Varjo XR-1 (paper section 2.4): per eye 1980x1980 over +-45 deg and 2400x1350
// over +-20 x +-11.57 deg, 60 Hz.
DisplayProfile xr1_profile();
// The same fields of view at half the pixels per axis.
DisplayProfile xr1_half_profile();

// Meta Quest 3: 2064x2208 pixels for each eye, 110 x 96 degrees of view and 90 Hz, as its maker publishes
// them, rounded; that each eye sees all of that field, and evenly about the forward axis, is assumed here.
DisplayProfile quest3_profile();
// No headset: per eye 2000x2000 over +-45 deg, 90 Hz, numbers made up to be round.
DisplayProfile generic_90_profile();

// The names of the built-in profiles: "xr1, xr1-half, quest3, generic-90".
std::string builtin_display_profile_names();
// A built-in profile, or none of that name.
std::optional<DisplayProfile> builtin_display_profile(const std::string& name);
// A built-in profile by name or the path of a JSON file. Throws InputError.
DisplayProfile load_display_profile(const std::string& name_or_path);
// The same fields of view with `scale` times the pixels along each axis, in (0, 1]: rounded, 1 at least.
DisplayProfile scaled_profile(DisplayProfile profile, double scale);
// An inline profile; `file` and `where` (a field path) name the place in error messages.
DisplayProfile parse_display_profile(const nlohmann::json& document, const std::filesystem::path& file,
                                     const std::string& where);

}  // namespace herr
