#include "server/cli/look_flags.h"

#include <CLI/CLI.hpp>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/settings_list.h"
#include "scenes/model/exposure.h"
#include "server/cli/flags.h"
#include "server/cli/setting_flags.h"
#include "server/settings/flag_values.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

struct NamedDirection {
  const char* name;
  LookDirection direction;
};
constexpr std::array<NamedDirection, 7> kNamedDirections{{{"three-quarter", {}},
                                                          {"front", {0, 0}},
                                                          {"back", {180, 0}},
                                                          {"left", {-90, 0}},
                                                          {"right", {90, 0}},
                                                          {"top", {0, 90}},
                                                          {"bottom", {0, -90}}}};

std::vector<std::string> direction_names() {
  std::vector<std::string> names;
  for (const NamedDirection& named : kNamedDirections) names.emplace_back(named.name);
  return names;
}

LookDirection direction_from(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) {
    if (text.find_first_of("0123456789") != std::string::npos)
      throw UsageError("--from: '" + printable(text) + "' is no direction; write AZIMUTH,ELEVATION as 30,15");
    return kNamedDirections.at(parse_word("--from", text, direction_names())).direction;
  }
  return {parse_signed_number("--from", text.substr(0, comma), 360),
          parse_signed_number(
              "--from", text.substr(std::min(text.find_first_not_of(' ', comma + 1), text.size())), 90)};
}

PictureFormats formats_from(const std::string& text) {
  try {
    return picture_formats_from(text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--format: ") + error.what());
  }
}

void add_camera_flags(CLI::App& app, LookOptions& options) {
  value_flag(app, "--size", "WxH", "pixels (default 800x800)", [&](const std::string& text) {
    const SizeValue size = parse_size("--size", text, kMostLookSide_px);
    options.width_px = size.width;
    options.height_px = size.height;
  });
  value_flag(app, "--from", "AZIMUTH,ELEVATION",
             "degrees: where the camera stands; 0,0 sees the front from +Z, 90,0 stands at +X; or " +
                 joined(direction_names()) + " (default three-quarter, 30,15)",
             [&](const std::string& text) { options.from = direction_from(text); });
  value_flag(app, "--fov", "DEG", "degrees that the shorter side of the picture sees (default 35)",
             [&](const std::string& text) { options.fov_deg = parse_real_number("--fov", text, 1, 170); });
  value_flag(
      app, "--distance", "X", "of the camera, times that at which the model fills the picture (default 1)",
      [&](const std::string& text) { options.distance = parse_real_number("--distance", text, 0, 1000); });
  value_flag(app, "--turntable", "N", "N pictures evenly around, counter-clockwise, in a new folder",
             [&](const std::string& text) {
               options.turntable =
                   static_cast<int>(parse_whole_number("--turntable", text, 1, kMostTurntable));
             });
  value_flag(app, "--time", "S", "seconds since animations and the timeline began (default 0)",
             [&](const std::string& text) { options.time_s = parse_real_number("--time", text, 0, 1e6); });
}

void add_picture_flags(CLI::App& app, LookOptions& options) {
  file_flag(app, "--out", "picture, .png or .exr, or the folder of --turntable (default: MODEL's name, here)",
            [&](const std::string& text) { options.out = text; });
  value_flag(app, "--format", "NAME,...",
             "png, exr or png,exr (default: by the ending of --out; a turntable's is png)",
             [&](const std::string& text) { options.formats = formats_from(text); });
  app.add_flag_callback(
      "--overwrite", [&] { options.overwrite = true; }, "replace what is there");
  value_flag(
      app, "--samples", "N",
      "rays per pixel, through places spread over it (default " + std::to_string(options.samples) + ")",
      [&](const std::string& text) {
        options.samples = static_cast<int>(parse_whole_number("--samples", text, 1, kMostLookSamples));
      });
  value_flag(app, "--background", "NAME", "environment, or none: transparent (default environment)",
             [&](const std::string& text) {
               options.background = parse_word("--background", text, {"environment", "none"}) == 0;
             });
  file_flag(app, "--environment", "picture of the light around: .hdr, .exr, .png or .jpg, equirectangular",
            [&](const std::string& text) { options.environment = text; });
  value_flag(app, "--exposure", "EV",
             "stops by which PNG pictures are brighter than scene values, or auto: by what is seen "
             "(default: the scene's, else auto)",
             [&](const std::string& text) {
               options.automatic_exposure = text == "auto";
               options.render.exposure_ev.reset();
               if (!options.automatic_exposure)
                 options.render.exposure_ev = parse_signed_number("--exposure", text, kMostExposure_ev);
             });
  app.add_flag_callback(
      "--json", [&] { options.json = true; }, "results on stdout as JSON");
}

}  // namespace

void add_look_flags(CLI::App& app, LookOptions& options) {
  app.add_option("MODEL", options.path, "model or scene: .gltf, .glb, .vox, .scene.json")
      ->required()
      ->type_name("");
  add_asset_root_flag(app, options.asset_roots);
  add_picture_flags(app, options);
  add_camera_flags(app, options);
  add_preset_flags(app, options.render, false);
  const std::vector<Setting> settings = settings_of(options.render);
  for (const char* name : {"light_samples", "first_light_samples", "occlusion_rays", "occlusion_radius_m",
                           "reflections", "refraction", "ray_width", "detail_error", "seed"})
    add_setting_flag(app, setting_named(settings, name));
  add_setting_flags(app, settings, {SettingGroup::probes, SettingGroup::machine});
}

}  // namespace herr
