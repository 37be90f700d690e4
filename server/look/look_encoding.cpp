#include "server/look/look_encoding.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "server/frames/auto_exposure.h"
#include "server/output/exr_encoder.h"
#include "server/output/png_encoder.h"
#include "server/process/version.h"
#include "server/results/settings_report.h"

namespace herr {

Exposure look_exposure(const LookOptions& options, const Scene& scene, bool studio,
                       const ViewportImage& model) {
  if (options.render.exposure_ev) return {false, *options.render.exposure_ev};
  if (!options.automatic_exposure && scene.exposure && !scene.exposure->automatic)
    return {false, scene.exposure->ev};
  DisplayProfile profile;
  profile.viewports.resize(1);
  const std::optional<double> metered = metered_ev({model}, profile);
  if (!studio || !metered) return {true, metered.value_or(0)};
  // metered_ev brings the brightest to kMeteredValue; here they may be white.
  return {true, std::min(0.0, *metered - std::log2(kMeteredValue))};
}

std::vector<std::uint8_t> encoded_look(const LookOptions& options, LookRenderer& renderer,
                                       const LookCamera& camera, const ViewportImage& picture,
                                       PictureFormat format) {
  std::vector<std::uint8_t> bytes;
  if (format == PictureFormat::png) {
    Srgb8Image image;
    srgb8_from_viewport(picture, !options.background, image);
    encode_png(image, bytes);
    return bytes;
  }
  PictureMetadata metadata;
  metadata.scene = options.path.filename().string();
  metadata.program = program_with_version();
  metadata.isa = name_of(renderer.renderer().settings().isa);
  metadata.world_from_session = renderer.scene().world_from_session;
  metadata.settings = "herr look, rays per pixel " + std::to_string(options.samples) +
                      (options.background ? "" : ", no background") + ", " +
                      settings_text(renderer.renderer().settings(), false);
  const ParallelFor parallel_for = [&](int count, const std::function<void(int)>& work) {
    renderer.renderer().parallel_for(count, work);
  };
  encode_exr({&picture}, pictures_of_frame(camera.profile, {}), renderer.sample(camera), metadata,
             parallel_for, bytes);
  return bytes;
}

}  // namespace herr
