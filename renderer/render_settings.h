// What the user can choose about a render; one struct, each field with its default and a sentence. The
// defaults are the paper's frame. Ranges, flags and names stand in settings/settings_list.cpp: a new field
// has a row there. Settings that go together by a name stand in settings/settings_presets.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/outside_view.h"

namespace herr {

inline constexpr int kMostLightSamples = 4096;
inline constexpr int kMostEdgeSamples = 16;
inline constexpr double kUsualFeedDistance_m = 2.0;
inline constexpr int kFewestProbeRays = 8, kMostProbeRays = 512;

enum class Foveation : std::uint8_t { log_polar, off };
enum class LightSampler : std::uint8_t { jittered, random };
// How viewport pixels are made of the samples around them. bicubic: Catmull-Rom, which keeps the samples.
enum class ResampleFilter : std::uint8_t { nearest, bilinear, bicubic };
// Whether pictures are made of what each eye sees, and as dense as which kind of viewport.
enum class Blend : std::uint8_t { off, context, focus };
enum class Isa : std::uint8_t { best, sse4, avx2, avx512 };

// Polar buffers that reach the acuity function have this size at most (foveation/reached_acuity.h): columns
// for a display that reaches to straight behind the gaze, rows for the circle that asks for the most, 21.0
// degrees off the gaze.
inline constexpr int kMostAcuityWidth = 1040, kAcuityHeight = 1174;

// Light that bounces between surfaces, gathered by a grid of probes over time.
struct ProbeSettings {
  bool on = true;
  int rays = 64;                    // per probe and update
  int budget = 0;                   // probes updated in a frame, in turn; 0 = all
  double hysteresis_tau_s = 0.365;  // time constant of what probes remember; 0 = nothing
  bool react = true;                // forget faster where light changes by more than a quarter
  double normal_bias = 0.1;         // look-ups see from this share of the smallest spacing off the surface
  double view_bias = 0.0;           // and from this share of it towards the viewer
  double density = 1;               // probes along each axis, against those that the scene asks for
};

struct RenderSettings {
  Foveation foveation = Foveation::log_polar;        // off: one ray per viewport pixel (but see scale)
  ResampleFilter filter = ResampleFilter::bilinear;  // samples to viewport pixels; the feed stays bilinear
  double scale = 1;        // rays per viewport pixel and axis; without foveation only
  int polar_width = 788;   // radial samples per eye (the paper's "1576x768" counts both eyes)
  int polar_height = 768;  // angular samples, an even number
  // In place of both sizes: the columns of each frame and eye, and kAcuityHeight rows, that reach
  // 200 / (theta + 1) samples per degree everywhere on the display.
  bool polar_acuity = false;
  int light_samples = 1;  // per light and hit; 1 = centre of the light, hard shadows
  // Adaptive light samples: this many strata are traced for every hit, more only where they disagree
  // (direct_light/adaptive_light-inl.h); of at most kMostAdaptiveSamples. 0: all for every hit.
  int adaptive_min_samples = 0;
  // random: independent places on the light, what strata are measured against.
  LightSampler light_sampler = LightSampler::jittered;
  int occlusion_rays = 1;           // short rays of ambient occlusion per first hit; 0: none
  double occlusion_radius_m = 0.3;  // how far they reach
  // Further rays through each polar sample at an edge, of surfaces or of hard shadows, an even number up to
  // 16; half as many where the edge is faint. 0: none.
  int edge_samples = 0;
  // Rays from the eye are this many times as wide as their samples: textures and voxels are read at the level
  // that this asks for. 0: the finest.
  double ray_width = 1;
  double detail_error = 0.5;   // samples that a simplified mesh may lie off; 0: full meshes only
  bool covered_pixels = true;  // without foveation: trace context pixels that a focus viewport covers
  // Each hit takes the mean of what the short rays of hits nearby found on the same surface: of up to nine
  // times as many.
  bool occlusion_smoothing = true;
  bool reflections = true;       // trace one mirror bounce where a material asks for it
  bool refraction = true;        // follow light through transparent materials; off: they are opaque
  bool camera = true;            // composite over the camera feed where the session has one
  bool gaze_marker = false;      // red circle around the gaze direction in every viewport
  bool debug_tiles = false;      // colour the polar buffer in tiles of 15 degrees (Figure 6)
  bool density_overlay = false;  // lines of degrees off the gaze and of sample density in every viewport
  // Painted over the feed, or where one would be seen: times the catcher's ratio, so that shadows show. None:
  // the feed is shown.
  std::optional<ShownColour> see_through_colour;
  Blend blended_view = Blend::off;  // further pictures: focus viewports blended into the context
  // The camera feed is re-projected as if it lay on a sphere of this radius, metres, whose centre is the eye
  // that is displayed. None: the distance that the session names, else kUsualFeedDistance_m.
  std::optional<double> feed_distance_m;
  // Stops by which pictures are shown brighter than scene values. None: the scene's own, else 0.
  std::optional<double> exposure_ev;
  bool auto_exposure = false;  // from the first frame of the session, in place of it
  ProbeSettings probes;
  std::uint32_t seed = 0;  // of the random numbers, beside time, eye and sample
  // Entries of the frame plan that run although the scene has nothing for them, by name: the picture is the
  // same, bit for bit. To see what leaving them out saves.
  std::vector<std::string> force;
  std::optional<OutsideView> outside;  // a further picture of each frame; read from a file, so it has no row
  int threads = 0;                     // 0 = all that this process may use
  Isa isa = Isa::best;                 // instruction set of kernels and Embree
};

// "sse4", "avx2", "avx512". The one that runs: best resolved against this CPU.
const char* name_of(Isa isa);
// Resolves `best`; throws std::invalid_argument when this CPU lacks the one asked for.
Isa resolve_isa(Isa asked);

}  // namespace herr
