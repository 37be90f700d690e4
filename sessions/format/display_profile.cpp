#include "sessions/format/display_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

constexpr double kWidestDeg = 89.5;     // tan is 115: a plane can be no wider
constexpr double kNarrowestDeg = 0.01;  // 36 arc seconds: below it borders lose digits against each other
constexpr double kEdgeBlendDeg =
    1.0;  // the paper names no width; one degree is the focus display's outer 5 %
constexpr std::size_t kMaxViewports = 64;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;  // 8 bytes each

Viewport symmetric(const std::string& name, Eye eye, bool focus, int width_px, int height_px,
                   double half_width_deg, double half_height_deg) {
  Viewport viewport{name, eye, focus, width_px, height_px};
  viewport.tan_right = std::tan(glm::radians(half_width_deg));
  viewport.tan_left = -viewport.tan_right;
  viewport.tan_up = std::tan(glm::radians(half_height_deg));
  viewport.tan_down = -viewport.tan_up;
  viewport.edge_blend_deg = focus ? kEdgeBlendDeg : 0;
  return viewport;
}

// One context viewport for each eye.
DisplayProfile one_for_each_eye(const std::string& name, double display_hz, int width_px, int height_px,
                                double half_width_deg, double half_height_deg) {
  DisplayProfile profile{name, display_hz, {}};
  for (const Eye eye : kEyes) {
    const std::string side = eye == Eye::left ? "left_" : "right_";
    profile.viewports.push_back(
        symmetric(side + "context", eye, false, width_px, height_px, half_width_deg, half_height_deg));
  }
  return profile;
}

// The one list of what is built in.
struct BuiltIn {
  const char* name;
  DisplayProfile (*make)();
};
constexpr std::array kBuiltIns{BuiltIn{"xr1", xr1_profile}, BuiltIn{"xr1-half", xr1_half_profile},
                               BuiltIn{"quest3", quest3_profile}, BuiltIn{"generic-90", generic_90_profile}};

DisplayProfile xr1_over(const std::string& name, int divisor) {
  DisplayProfile profile{name, 60, {}};
  for (const Eye eye : kEyes) {
    const std::string side = eye == Eye::left ? "left_" : "right_";
    profile.viewports.push_back(
        symmetric(side + "context", eye, false, 1980 / divisor, 1980 / divisor, 45, 45));
    profile.viewports.push_back(
        symmetric(side + "focus", eye, true, 2400 / divisor, 1350 / divisor, 20, 11.57));
  }
  return profile;
}

std::string checked_name(const JsonObject& entry) {
  const std::string name = entry.text("name");
  const bool good = !name.empty() && name.size() <= 40 &&
                    name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
  if (!good)
    entry.fail("name", "is '" + printable(name) + "'",
               "it becomes part of file names: use 1 to 40 of a-z, 0-9 and _");
  return name;
}

// True for `yes`, false for `no`; anything else is an error.
bool chosen(const JsonObject& entry, const char* key, const char* yes, const char* no) {
  const std::string word = entry.text(key);
  if (word != yes && word != no)
    entry.fail(key, "is '" + printable(word) + "'", std::string("write ") + yes + " or " + no);
  return word == yes;
}

Viewport parse_viewport(const JsonObject& entry) {
  entry.allow_only({"name", "eye", "kind", "width_px", "height_px", "left_deg", "right_deg", "down_deg",
                    "up_deg", "edge_blend_deg"});
  Viewport viewport;
  viewport.name = checked_name(entry);
  viewport.eye = chosen(entry, "eye", "left", "right") ? Eye::left : Eye::right;
  viewport.focus = chosen(entry, "kind", "focus", "context");
  viewport.width_px = static_cast<int>(entry.integer("width_px", 1, 16384));
  viewport.height_px = static_cast<int>(entry.integer("height_px", 1, 16384));
  const auto border = [&](const char* key) { return entry.number(key, -kWidestDeg, kWidestDeg); };
  const double left = border("left_deg"), right = border("right_deg");
  const double down = border("down_deg"), up = border("up_deg");
  if (right - left < kNarrowestDeg)
    entry.fail("right_deg", "is not right of left_deg", "angles grow to the right, e.g. -45 and 45");
  if (up - down < kNarrowestDeg)
    entry.fail("up_deg", "is not above down_deg", "angles grow upwards, e.g. -45 and 45");
  viewport.tan_left = std::tan(glm::radians(left));
  viewport.tan_right = std::tan(glm::radians(right));
  viewport.tan_down = std::tan(glm::radians(down));
  viewport.tan_up = std::tan(glm::radians(up));
  viewport.edge_blend_deg = entry.number_or("edge_blend_deg", 0, 45, 0);
  return viewport;
}

}  // namespace

double finest_pixels_per_degree(const Viewport& v) {
  // A plane at distance 1: d(tan) / d(angle) = 1 + tan^2 along the way from the middle.
  const double x = std::max(std::abs(v.tan_left), std::abs(v.tan_right));
  const double y = std::max(std::abs(v.tan_down), std::abs(v.tan_up));
  const double per_tan =
      std::max(v.width_px / (v.tan_right - v.tan_left), v.height_px / (v.tan_up - v.tan_down));
  return per_tan * (1.0 + x * x + y * y) * glm::radians(1.0);
}

DisplayProfile xr1_profile() {
  return xr1_over("xr1", 1);
}
DisplayProfile xr1_half_profile() {
  return xr1_over("xr1-half", 2);
}
DisplayProfile quest3_profile() {
  return one_for_each_eye("quest3", 90, 2064, 2208, 55, 48);
}
DisplayProfile generic_90_profile() {
  return one_for_each_eye("generic-90", 90, 2000, 2000, 45, 45);
}

std::string builtin_display_profile_names() {
  std::string names;
  for (const BuiltIn& each : kBuiltIns) names += (names.empty() ? "" : ", ") + std::string(each.name);
  return names;
}

std::optional<DisplayProfile> builtin_display_profile(const std::string& name) {
  for (const BuiltIn& each : kBuiltIns) {
    if (name == each.name) return each.make();
  }
  return std::nullopt;
}

DisplayProfile load_display_profile(const std::string& name_or_path) {
  if (const auto builtin = builtin_display_profile(name_or_path)) return *builtin;
  const std::filesystem::path path(name_or_path);
  // A path that cannot be examined does not exist for us: the error below says so.
  if (path.extension() != ".json" && !path_exists(path))
    throw InputError(path, 0, "is neither a built-in display profile nor a file",
                     "use " + builtin_display_profile_names() + " or the path of a JSON file");
  return parse_display_profile(parse_json_file(path), path, "");
}

DisplayProfile scaled_profile(DisplayProfile profile, double scale) {
  const auto scaled = [scale](int pixels) {
    return std::max(1, static_cast<int>(std::lround(scale * pixels)));
  };
  for (Viewport& viewport : profile.viewports) {
    viewport.width_px = scaled(viewport.width_px);
    viewport.height_px = scaled(viewport.height_px);
  }
  return profile;
}

DisplayProfile parse_display_profile(const nlohmann::json& document, const std::filesystem::path& file,
                                     const std::string& where) {
  const JsonObject root(document, file, where);
  root.allow_only({"name", "display_hz", "viewports"});
  DisplayProfile profile;
  profile.name = root.text("name");
  profile.display_hz = root.number("display_hz", 1, 1000);
  const std::vector<JsonObject> entries = root.objects("viewports");
  if (entries.empty() || entries.size() > kMaxViewports)
    root.fail("viewports", "has " + std::to_string(entries.size()) + " elements", "list 1 to 64 viewports");
  std::set<std::string> names;
  std::int64_t pixels = 0;
  for (const JsonObject& entry : entries) {
    profile.viewports.push_back(parse_viewport(entry));
    const std::string& name = profile.viewports.back().name;
    if (!names.insert(name).second)
      entry.fail("name", "'" + name + "' is used twice", "give each viewport a name of its own");
    pixels += std::int64_t{profile.viewports.back().width_px} * profile.viewports.back().height_px;
  }
  if (pixels > kMaxPixels) {
    root.fail("viewports", "hold " + std::to_string(pixels) + " pixels together",
              "keep them to " + std::to_string(kMaxPixels) + " (2 GiB of picture)");
  }
  return profile;
}

}  // namespace herr
