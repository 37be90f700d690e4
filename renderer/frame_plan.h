// Which stages and kernel features a frame runs, and why the others are left out.
// A pure function of scene traits, session traits and settings; its choice never changes the picture.
#pragma once

#include <string>
#include <vector>

#include "renderer/render_settings.h"
#include "scenes/model/scene.h"

namespace herr {

// Interfaces at which light is followed on at most, through glass and off it; beyond them a path brings what
// comes from outside along its direction. A solid object has two on the straight way, a hollow one four.
inline constexpr int kMostInterfaces = 12;
// Rays that follow light through glass, per sample in the mean of a tile at most.
inline constexpr int kMostGlassRays = 32;

// Blended surfaces that eyes look through at most, one behind another.
inline constexpr int kMostLayers = 8;

// How the lights of one frame are sampled.
struct LightSampling {
  int samples = 1;  // per light and hit
  int first = 1;    // of these, traced for every hit; the others only where the first ones disagree
  bool stratified = true;
  bool adaptive() const { return first < samples; }
};

struct PlanEntry {
  std::string name;  // stage or kernel feature, e.g. "mirror rays"
  bool runs = false;
  std::string reason;     // "3 of 11 instances reflect", "no material reflects"
  bool unneeded = false;  // the scene has nothing that it is for: it runs only where the settings force
};

inline constexpr const char* kColouredRatio = "coloured catcher ratio";
inline constexpr const char* kMirroredFeed = "feed in mirrors and glass";

struct FramePlan {
  // What the kernels are chosen by.
  bool polar = true;  // log-polar buffer; false: a planar grid of rays per viewport
  bool mirror_rays = false;
  bool catcher_mirrors = false;  // mirror rays of catchers: virtual objects reflect in the real room
  bool refraction = false;
  int edge_samples = 0;  // further rays through each sample at an edge; 0: none
  bool occlusion = false;
  bool environment_map = false;
  bool textures = false;
  bool voxels = false;           // octrees, and rays that know how wide they are
  bool shapes = false;           // analytic spheres and boxes
  bool surface_details = false;  // vertex colours, further textures, highlights of their own, unlit, alpha
  bool further_lobes = false;    // clear coats, sheen, stretched highlights
  bool gloss = false;            // some surface reflects by its roughness more than even light
  bool filtered_environment = false;  // highlights show the environment picture as their lobe blurs it
  bool alpha_mask = false;            // hits are asked whether they lie in a hole
  bool alpha_blend = false;           // eyes look on through what they hit; shadow rays pass by shares
  bool back_face_culling =
      false;  // eyes' hits are asked whether they lie on the back of a single-sided surface
  bool catchers = false;
  bool catchers_occlude =
      false;  // catchers can shadow one another: needs a second shadow ray where the first is blocked
  bool virtual_lights = false;  // some light is not in the feed: what the ratio cannot carry is added to it
  bool coloured_ratio = false;  // some light is coloured: the catcher ratio needs three channels
  int adaptive_min_samples =
      0;                // where samples are adaptive, how many are traced for every hit; 0: they never are
  bool probes = false;  // light that came by other surfaces
  bool catcher_probes = false;  // a second set of probes that sees catchers alone
  bool specular = false;        // some material has a specular lobe
  bool detail_levels = false;   // some mesh has coarser forms
  bool camera = false;
  bool mirrored_feed = false;  // rays of mirrors and glass show the camera feed
  bool gaze_marker = false;
  bool density_overlay = false;
  LightSampler light_sampler = LightSampler::jittered;
  std::vector<PlanEntry> entries;  // all of the above, for people

  // Of a frame that takes `samples` of each light: the settings' number, or the frame's own.
  LightSampling light_sampling(int samples) const;
};

// Of the instances that are there now; what needs memory for the whole run (probes) counts those that may
// come, too. `session_has_camera`: the session delivers camera frames.
FramePlan plan_frame(const Scene& scene, const RenderSettings& settings, bool session_has_camera);

// Entries that the settings could force on without changing the picture (RenderSettings::force).
std::vector<std::string> left_out(const FramePlan& plan);

// One line that names the glowing objects whose light reaches nothing around them, and not the camera feed:
// probes alone carry it. Empty where they run, where nothing glows, or where there is no catcher.
std::string glow_without_light(const Scene& scene, const FramePlan& plan);

// Entries of `after` that run where those of `before` do not, or the other way round.
std::vector<PlanEntry> differing_entries(const FramePlan& before, const FramePlan& after);

}  // namespace herr
