#include "server/results/settings_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "renderer/settings_list.h"
#include "server/settings/quality_target.h"
#include "server/settings/run_settings.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;
using Names = std::vector<std::string_view>;

bool is_among(const Names& names, const Setting& setting) {
  return std::find(names.begin(), names.end(), setting.name) != names.end();
}

Json json_of(const PlainValue& value) {
  return std::visit(
      [](const auto& plain) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(plain)>, std::monostate>) {
          return nullptr;
        } else {
          return plain;
        }
      },
      value);
}

// "light samples 64", "no camera", "probes", "foveation off", "occlusion radius 0.5 m".
std::string phrase(const Setting& setting) {
  const std::string text = text_of(setting);
  if (is_switch(setting)) return (text == "on" ? "" : "no ") + label_of(setting);
  return label_of(setting) + " " + text + (setting.unit.empty() ? "" : " " + setting.unit);
}

// What means nothing in a session without a camera feed, and is not told.
Names without_meaning(bool session_has_camera) {
  if (session_has_camera) return {};
  return {"camera", "feed_distance_m"};
}

// `defaults` are the same rows of a struct that nobody changed. What changes nothing beside the others is not
// told.
std::string line_of(const std::vector<Setting>& settings, const std::vector<Setting>& defaults,
                    const Names& left_out) {
  static const Names kAlwaysTold{"polar",       "light_samples", "occlusion_rays",
                                 "reflections", "probes",        "camera"};
  std::string always, further;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const Setting& setting = settings[i];
    if (!shapes_pictures(setting) || is_idle(setting) || is_among(left_out, setting)) continue;
    const bool told = is_among(kAlwaysTold, setting);
    if (!told && text_of(setting) == text_of(defaults[i])) continue;
    std::string& line = told ? always : further;
    line += (line.empty() ? "" : ", ") + phrase(setting);
  }
  return always + (always.empty() || further.empty() ? "" : ", ") + further;
}

std::string line_of_render(RenderSettings settings, bool session_has_camera, Names left_out) {
  RenderSettings defaults;
  for (const std::string_view name : without_meaning(session_has_camera)) left_out.push_back(name);
  return line_of(settings_of(settings), settings_of(defaults), left_out);
}

std::string line_of_run(const ReplayOptions& resolved, bool session_has_camera, Names left_out) {
  ReplayOptions told = resolved, defaults;
  for (const std::string_view name : without_meaning(session_has_camera)) left_out.push_back(name);
  return line_of(settings_of(told), settings_of(defaults), left_out);
}

}  // namespace

ReplayOptions resolved_options(const ReplayOptions& options, const SessionReport& report) {
  ReplayOptions resolved = options;
  resolved.render = report.settings;
  resolved.profile = printable(report.profile.name);
  if (report.settings.outside) resolved.view = report.settings.outside->name;
  return resolved;
}

Json settings_json(const ReplayOptions& resolved) {
  ReplayOptions told = resolved;
  Json json;
  for (const Setting& setting : settings_of(told)) {
    if (setting.name == "polar") {
      json["polar"] = json_of(value_of(setting));
      json["polar_width_per_eye"] = told.render.polar_width;
      json["polar_height"] = told.render.polar_height;
    } else if (setting.name == "polar_floor") {
      const bool fixed = told.policy == QualityPolicy{};
      json["polar_floor_per_eye"] = fixed ? Json(nullptr) : Json(narrowest_width(told, told.render));
    } else if (setting.name == "polar_floor_height") {
      json[setting.name] = told.policy.deadline ? Json(lowest_height(told, told.render)) : Json(nullptr);
    } else {
      json[setting.name] = json_of(value_of(setting));
    }
  }
  return json;
}

std::string settings_text(const ReplayOptions& resolved, bool session_has_camera) {
  return line_of_run(resolved, session_has_camera, {});
}

std::string headline_text(const ReplayOptions& options, const SessionReport& report) {
  return line_of_run(resolved_options(options, report), report.findings.camera_rows[0] > 0, {"isa"});
}

std::string settings_text(const RenderSettings& settings, bool session_has_camera) {
  return line_of_render(settings, session_has_camera, {"isa"});
}

std::string features_text(const RenderSettings& settings, bool session_has_camera) {
  return line_of_render(settings, session_has_camera, {"isa", "polar", "light_samples"});
}

}  // namespace herr
