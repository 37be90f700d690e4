#include "renderer/settings_list.h"

#include <utility>

#include "scenes/model/scene.h"

namespace herr {
namespace {

using Group = SettingGroup;
using Effect = SettingEffect;

constexpr int kLargestPolar = 8192;
constexpr double kLargestSeed = 4294967295;  // 32 bits
constexpr double kLongestMemory_s = 1e6, kNearest_m = 1e-9, kFarthest_m = 1e9;

// The row, and beside what its value changes nothing.
Setting idle_beside(Setting setting, std::function<std::string()> what) {
  setting.idle_beside = std::move(what);
  return setting;
}

// `what` while `idle` holds.
std::string where(bool idle, const std::string& what) {
  return idle ? what : std::string();
}

bool is_foveated(const RenderSettings& s) {
  return s.foveation == Foveation::log_polar;
}

constexpr const char* kNoPolarBuffer = "--foveation off, which has no polar buffer";
constexpr const char* kFoveated = "foveation; give --foveation off";

// As the plan of a frame decides it (FramePlan::light_sampling).
std::string adaptive_beside(const RenderSettings& s) {
  const std::string given = "--light-samples " + std::to_string(s.light_samples);
  if (s.adaptive_min_samples == 0) return {};
  if (s.light_samples > kMostAdaptiveSamples)
    return given + ", which is more than adaptive samples go; give at most " +
           std::to_string(kMostAdaptiveSamples);
  return where(s.light_samples <= s.adaptive_min_samples,
               given + ", which are traced at once; give more of them");
}

std::string feed_beside(const RenderSettings& s) {
  if (!s.camera) return "--no-camera";
  return where(s.see_through_colour.has_value(), "--see-through-colour, which hides the feed");
}

// Rows: name, flag, unit, group, effect, sentence, value; then what holds where it has none.

std::vector<Setting> of_rays(RenderSettings& s) {
  return {
      {"foveation", "--foveation", "", Group::look, Effect::error_for_time,
       "log-polar, or off: one ray per pixel", one_of(s.foveation, {"log-polar", "off"})},
      idle_beside({"scale", "--scale", "", Group::look, Effect::error_for_time,
                   "rays per pixel and axis without foveation; with it, no effect", real(s.scale, 0.05, 1)},
                  [&s] { return where(is_foveated(s), kFoveated); }),
      idle_beside({"filter", "--filter", "", Group::rays, Effect::error_for_time,
                   "how pixels are made of the samples around them: nearest, bilinear or bicubic",
                   one_of(s.filter, {"nearest", "bilinear", "bicubic"})},
                  [&s] {
                    return where(!is_foveated(s) && s.scale == 1,
                                 "--foveation off at scale 1, where each pixel has a ray of its own");
                  }),
      idle_beside(
          {"polar", "--polar", "", Group::rays, Effect::error_for_time,
           "polar buffer of both eyes together, or acuity: as many samples of each frame and eye as give "
           "200 / (theta + 1) per degree everywhere on the display, theta in degrees off the gaze",
           SizeSetting{&s.polar_width, &s.polar_height, kLargestPolar, kLargestPolar, &s.polar_acuity,
                       "acuity", kMostAcuityWidth, kAcuityHeight}},
          [&s] { return where(!is_foveated(s), kNoPolarBuffer); }),
      {"light_samples", "--light-samples", "", Group::rays, Effect::error_for_time,
       "shadow rays per light and hit; 1: hard shadows", whole(s.light_samples, 1, kMostLightSamples)},
      idle_beside(
          {"first_light_samples", "--first-light-samples", "", Group::rays, Effect::error_for_time,
           "adaptive, up to 256 light samples: trace N (4 serves well), more only where they disagree, 32 "
           "at most unless N asks for more; right in the mean; 0: all",
           whole(s.adaptive_min_samples, 0, kMostLightSamples)},
          [&s] { return adaptive_beside(s); }),
      idle_beside(
          {"edge_samples", "--edge-samples", "", Group::rays, Effect::error_for_time,
           "further rays through polar samples at edges of surfaces and hard shadows, half as many where the "
           "edge is faint; even; 0: none",
           number_setting(s.edge_samples, 0, kMostEdgeSamples, 2)},
          [&s] { return where(s.edge_samples > 0 && !is_foveated(s), kNoPolarBuffer); }),
      {"occlusion_rays", "--occlusion-rays", "", Group::rays, Effect::error_for_time,
       "short rays of ambient occlusion per hit; 0: none", whole(s.occlusion_rays, 0, 64)},
      {"light_sampler", "", "", Group::rays, Effect::pictures,
       "jittered strata of a light, or random: independent places on it",
       one_of(s.light_sampler, {"jittered", "random"})},
      idle_beside({"occlusion_radius_m", "--occlusion-radius", "m", Group::rays, Effect::pictures,
                   "metres that they reach", real(s.occlusion_radius_m, kNearest_m, kFarthest_m)},
                  [&s] { return where(s.occlusion_rays == 0, "no occlusion rays; give --occlusion-rays"); }),
      idle_beside({"occlusion_smoothing", "--no-occlusion-smoothing", "", Group::rays, Effect::error_for_time,
                   "leave out the mean over what the short rays of neighbours on the same surface found",
                   on_off(s.occlusion_smoothing)},
                  [&s] { return where(s.occlusion_rays == 0, "no occlusion rays; give --occlusion-rays"); }),
      {"reflections", "--no-reflections", "", Group::rays, Effect::error_for_time, "trace no mirror rays",
       on_off(s.reflections)},
      {"refraction", "--no-refraction", "", Group::rays, Effect::error_for_time,
       "draw transparent materials opaque", on_off(s.refraction)},
      {"ray_width", "--ray-width", "", Group::rays, Effect::error_for_time,
       "rays from the eye against their samples: levels of textures and voxels; 0: finest",
       real(s.ray_width, 0, 64)},
      {"detail_error", "--detail-error", "", Group::rays, Effect::error_for_time,
       "samples that a simplified mesh may lie off; 0: full meshes", real(s.detail_error, 0, 64)},
      idle_beside({"covered_pixels", "--no-covered-pixels", "", Group::look, Effect::pictures,
                   "without foveation: leave context pixels black that a focus viewport covers",
                   on_off(s.covered_pixels)},
                  [&s] { return where(is_foveated(s), kFoveated); }),
      {"seed", "--seed", "", Group::rays, Effect::pictures,
       "of the random numbers: another one gives other noise", whole(s.seed, 0, kLargestSeed)},
  };
}

std::vector<Setting> of_probes(ProbeSettings& p) {
  return {
      {"probes", "--no-probes", "", Group::probes, Effect::pictures,
       "constant ambient light in place of light that bounces between surfaces", on_off(p.on), "",
       "--probes"},
      idle_beside({"probe_rays", "--probe-rays", "", Group::probes, Effect::error_for_time,
                   "rays of a probe and update", whole(p.rays, kFewestProbeRays, kMostProbeRays)},
                  [&p] { return where(!p.on, "no probes; give --probes"); }),
      idle_beside({"probe_budget", "--probe-budget", "", Group::probes, Effect::error_for_time,
                   "probes updated in a frame, in turn; 0: all", whole(p.budget, 0, kMostProbes)},
                  [&p] { return where(!p.on, "no probes; give --probes"); }),
      idle_beside(
          {"probe_density", "--probe-density", "", Group::probes, Effect::error_for_time,
           "probes along each axis, against those that the scene asks for", real(p.density, 0.125, 8)},
          [&p] { return where(!p.on, "no probes; give --probes"); }),
      {"probe_hysteresis_tau_s", "", "s", Group::probes, Effect::pictures,
       "time constant of what probes remember; 0: nothing", real(p.hysteresis_tau_s, 0, kLongestMemory_s)},
      {"probe_reaction", "", "", Group::probes, Effect::pictures,
       "probes forget faster where light changes by more than a quarter", on_off(p.react)},
      {"probe_normal_bias", "", "", Group::probes, Effect::pictures,
       "look-ups see from this share of the smallest spacing off the surface", real(p.normal_bias, 0, 1)},
      {"probe_view_bias", "", "", Group::probes, Effect::pictures,
       "and from this share of it towards the viewer", real(p.view_bias, 0, 1)},
  };
}

// None reads as the usual one, which holds unless a session names another.
NumberSetting feed_distance(std::optional<double>& distance_m) {
  NumberSetting setting;
  setting.get = [&distance_m]() -> std::optional<double> {
    return distance_m.value_or(kUsualFeedDistance_m);
  };
  setting.set = [&distance_m](std::optional<double> number) { distance_m = number; };
  setting.lowest = kNearest_m;
  setting.highest = kFarthest_m;
  return setting;
}

// None reads as 0, which holds unless the scene names another.
NumberSetting exposure(std::optional<double>& ev) {
  NumberSetting setting;
  setting.get = [&ev]() -> std::optional<double> { return ev.value_or(0); };
  setting.set = [&ev](std::optional<double> number) { ev = number; };
  setting.lowest = -kMostExposure_ev;
  setting.highest = kMostExposure_ev;
  return setting;
}

// None reads as no text: the feed is shown.
TextSetting see_through(std::optional<ShownColour>& colour) {
  return {[&colour] { return colour ? text_of(*colour) : std::string(); },
          [&colour](const std::string& text) { colour = shown_colour_from(text); }, "RRGGBB|R,G,B",
          text_of(kPink)};
}

std::vector<Setting> of_pictures(RenderSettings& s) {
  return {
      {"camera", "--no-camera", "", Group::rays, Effect::pictures,
       "leave the camera feed out: pictures are then an overlay with alpha, transparent where the feed would "
       "be (EXR: premultiplied)",
       on_off(s.camera)},
      {"gaze_marker", "--gaze-marker", "", Group::look, Effect::pictures, "red circle at the gaze",
       on_off(s.gaze_marker)},
      {"see_through_colour", "--see-through-colour", "", Group::look, Effect::pictures,
       "paint this sRGB colour where the camera feed is seen, or would be: shadows of virtual things darken "
       "it; mirrors and glass then show the environment in place of the feed",
       see_through(s.see_through_colour), "the camera feed"},
      idle_beside({"debug_tiles", "--debug-tiles", "", Group::look, Effect::pictures,
                   "colour the polar buffer in tiles of 15 degrees", on_off(s.debug_tiles)},
                  [&s] { return where(!is_foveated(s), kNoPolarBuffer); }),
      idle_beside({"feed_distance_m", "--feed-distance", "m", Group::look, Effect::pictures,
                   "the camera feed is shown as if it lay on a sphere of this radius about the displayed "
                   "eye; where the "
                   "session names a distance, that one is the default",
                   feed_distance(s.feed_distance_m)},
                  [&s] { return feed_beside(s); }),
      {"exposure_ev", "--exposure", "ev", Group::look, Effect::pictures,
       "stops (EV) by which PNG pictures are brighter than scene values: each 1 doubles them; EXR pictures "
       "keep scene values and name it",
       exposure(s.exposure_ev)},
      {"auto_exposure", "--auto-exposure", "", Group::look, Effect::pictures,
       "choose the exposure by the first frame of the session, whichever frames are drawn",
       on_off(s.auto_exposure)},
      {"density_overlay", "--density-overlay", "", Group::look, Effect::pictures,
       "lines of degrees off the gaze (blue) and of samples per degree (yellow) over every viewport; "
       "counted in frame_ms",
       on_off(s.density_overlay)},
  };
}

std::vector<Setting> of_views(RenderSettings& s) {
  return {
      {"blended_view", "--blended-view", "", Group::views, Effect::pictures,
       "a further picture of what each eye sees, focus viewports blended into the context as the headset "
       "does: "
       "off, or as dense as the viewports of kind context or focus",
       one_of(s.blended_view, {"off", "context", "focus"})},
  };
}

std::vector<Setting> of_machine(RenderSettings& s) {
  return {
      {"threads", "--threads", "", Group::machine, Effect::none, "render threads",
       whole_or_zero(s.threads, 1, 512), "all this process may use"},
      // Pictures differ in the last bits.
      {"isa", "--isa", "", Group::machine, Effect::pictures, "instruction set: best, sse4, avx2 or avx512",
       one_of(s.isa, {"best", "sse4", "avx2", "avx512"})},
  };
}

}  // namespace

// A new field changes the size: give it a row above (or say in render_settings.h why it has none), then this
// number.
static_assert(sizeof(ProbeSettings) == 56 && sizeof(RenderSettings) == 376);

std::vector<Setting> settings_of(RenderSettings& settings) {
  std::vector<Setting> all;
  for (const std::vector<Setting>& part : {of_rays(settings), of_probes(settings.probes),
                                           of_pictures(settings), of_views(settings), of_machine(settings)}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

void check_settings(const RenderSettings& settings) {
  RenderSettings checked = settings;
  for (const Setting& setting : settings_of(checked)) check_range(setting);
}

}  // namespace herr
