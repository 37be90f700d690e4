#include "server/study/reference/reference_spec.h"

#include <algorithm>
#include <variant>

#include "renderer/settings_list.h"
#include "server/study/plan/knobs.h"

namespace herr {
namespace {

constexpr int kPassSamples = 16;        // light samples and short rays of one pass
constexpr double kPassRayWidth = 0.25;  // of a pixel that 16 rays or more share
constexpr int kProbeRays = 512;         // the noise of probes stays, however many rays look at it
constexpr int kPasses = 8, kSoftPasses = 3;

// Rays through every seen pixel, and nothing saved.
RenderSettings through_pixels(RenderSettings settings) {
  settings.foveation = Foveation::off;
  settings.scale = 1;
  settings.covered_pixels = false;  // no error counts there
  settings.adaptive_min_samples = 0;
  settings.light_sampler = LightSampler::jittered;
  settings.detail_error = 0;
  settings.occlusion_smoothing = false;
  settings.ray_width = std::min(settings.ray_width, kPassRayWidth);
  return settings;
}

// As far as the setting's range goes.
void widen_polar(RenderSettings& settings, double factor) {
  const std::vector<Setting> rows = settings_of(settings);
  const auto& size = std::get<SizeSetting>(setting_named(rows, "polar").value);
  const auto scaled = [&](int value, int most) { return std::min(static_cast<int>(value * factor), most); };
  *size.width_per_eye = scaled(*size.width_per_eye, size.widest_per_eye);
  *size.height = 2 * scaled(*size.height / 2, size.highest / 2);
}

std::string model_name(const SettingChanges& model) {
  return model.empty() ? "" : ", " + flags_text(model);
}

}  // namespace

ReferenceSpec endless_effort(const RenderSettings& defaults, const SettingChanges& model) {
  ReferenceSpec spec;
  RenderSettings lit = with_changes(defaults, model);
  lit.adaptive_min_samples = 0;
  spec.settings = through_pixels(lit);
  spec.settings.light_samples = kPassSamples;
  if (lit.occlusion_rays > 0) spec.settings.occlusion_rays = kPassSamples;
  if (lit.probes.on) {
    spec.settings.probes.rays = std::max(lit.probes.rays, kProbeRays);
    spec.settings.probes.budget = 0;
    // A sweep of the probes themselves is no reason to take long.
    spec.refined = defaults.probes.on;
  }
  spec.name = "endless effort" + model_name(model);
  spec.passes = kPasses;
  spec.finest = lit;
  widen_polar(spec.finest, 1.5);
  spec.finest.light_samples = kSoftSamples;
  return spec;
}

ReferenceSpec own_reference(const RenderSettings& defaults, const StudySetting& setting) {
  const RenderSettings settings = with_changes(defaults, setting.changes);
  ReferenceSpec spec;
  spec.passes = kPasses;
  spec.same_probes = settings.probes.on && !setting.knob.starts_with("probe_");
  if (setting.own == OwnReference::pixels) {
    // The knob is one of resolution: all light as the setting has it.
    spec.settings = through_pixels(with_changes(with_changes(defaults, setting.model),
                                                {{"light_samples", std::to_string(settings.light_samples)}}));
    spec.name =
        (settings.light_samples == kHardSamples ? std::string("hard light")
                                                : std::to_string(settings.light_samples) + " light samples") +
        model_name(setting.model);
    spec.finest = defaults;
    spec.finest.light_samples = settings.light_samples;
    widen_polar(spec.finest, 2);
    return spec;
  }
  spec.by_pixels = false;
  // A sweep of the samples themselves is measured against their noise; others against what soft light leaves.
  const bool of_samples = setting.knob == "light_samples" || setting.knob == "adaptive_samples" ||
                          setting.knob == "first_light_samples";
  if (!of_samples && settings.light_samples > kHardSamples) spec.passes = kSoftPasses;
  spec.settings = with_changes(settings, setting.own_limit);
  spec.name = flags_text(changes_between(defaults, spec.settings));
  if (spec.name.empty()) spec.name = "the default";
  spec.name += ", " + std::to_string(2 * spec.passes) + " seeds";
  if (settings.probes.on && !spec.same_probes) spec.name += " and probes of two";
  spec.finest = spec.settings;
  return spec;
}

}  // namespace herr
