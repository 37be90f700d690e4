#include "server/look/look_report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "server/results/summary_json.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

std::string ev_text(double ev) {
  return (ev < 0 ? "" : "+") + fixed_text(ev, 2);
}

// Four digits, whatever the scale.
std::string significant(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

// Floors and walls that reach out of the picture: many are counted.
std::string beyond_words(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i)
    text += (text.empty() ? ", framed without " : ", ") +
            (names[i].empty() ? "an unnamed one" : printable(names[i]));
  return names.size() > kShown ? text + " and " + std::to_string(names.size() - kShown) + " more" : text;
}

}  // namespace

std::string look_text(const LookReport& report) {
  const std::string size = std::to_string(report.width_px) + "x" + std::to_string(report.height_px);
  std::string files = printable(report.out.string());
  for (const std::filesystem::path& file : report.also) files += ", " + printable(file.string());
  return files + ": " +
         (report.pictures > 1 ? std::to_string(report.pictures) + " pictures of " + size : size) + ", from " +
         shortest_text(report.from.azimuth_deg) + "," + shortest_text(report.from.elevation_deg) + " at " +
         significant(report.distance_m) + " m over " + shortest_text(report.fov_deg) + " degrees, exposure " +
         ev_text(report.exposure.ev) + " EV" + (report.exposure.automatic ? " (automatic)" : "") + ", " +
         report.light + ", " + counted(report.triangles, "triangle", "triangles") +
         beyond_words(report.beyond) + "\n";
}

std::string look_json(const LookReport& report) {
  nlohmann::ordered_json json{{"out", printable(report.out.string())},
                              {"also", nlohmann::ordered_json::array()},
                              {"pictures", report.pictures},
                              {"width_px", report.width_px},
                              {"height_px", report.height_px},
                              {"azimuth_deg", report.from.azimuth_deg},
                              {"elevation_deg", report.from.elevation_deg},
                              {"framed_without", report.beyond},
                              {"distance_m", report.distance_m},
                              {"fov_deg", report.fov_deg},
                              {"exposure_ev", report.exposure.ev},
                              {"exposure", report.exposure.automatic ? "automatic" : "given"},
                              {"light", report.light},
                              {"triangles", report.triangles},
                              {"warnings", report.warnings}};
  for (const std::filesystem::path& file : report.also) json["also"].push_back(printable(file.string()));
  return json_text(json);
}

}  // namespace herr
