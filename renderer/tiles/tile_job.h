// What travels between the stages of a tile, as plain structures of arrays.
// A tile is 32x32 samples of a polar buffer (or of a viewport, without foveation). Its batches live in one
// worker's scratch memory and stay in that core's L2 cache while the tile goes through the stages.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "renderer/embree/embree_api.h"
#include "renderer/foveation/ray_grids.h"
#include "renderer/frame_counters.h"
#include "renderer/frame_plan.h"
#include "renderer/geometry/shading_scene.h"
#include "renderer/probes/probe_view.h"
#include "renderer/stage_times.h"
#include "renderer/threads/stage_clock.h"
#include "renderer/tiles/edge_samples.h"
#include "renderer/tiles/environment_record.h"
#include "renderer/tiles/hit_lanes.h"
#include "renderer/tiles/ray_recorder.h"

namespace herr {

// How much a kernel knows of surfaces. plain: factors. textures: base colour and metallic-roughness, one set
// of coordinates. all: whatever a DetailRecord holds.
enum class SurfaceDetail : std::uint8_t { plain, textures, all };
// none: no sample here; miss: the ray left the scene.
enum class HitKind : std::int32_t { none = 0, object = 1, catcher = 2, miss = 3 };

// What hits have beyond diffuse and one highlight: only where the plan has further lobes.
struct alignas(64) FurtherLobes {
  Lane<float> coat;         // share of the clear coat, 0 without one
  Lane<float> coat_alpha2;  // its GGX alpha squared
  Lane3 coat_normal;        // unit, on the viewer's side
  Lane3 sheen;              // colour, 0 without one
  Lane<float> sheen_alpha;  // of the Charlie distribution: roughness^2
  Lane3 tangent;            // unit, along which the highlight is longest; across the shading normal
  Lane<float> stretch;      // strength of anisotropy, 0 without it
};

// What hits have that reflect by their roughness: only where the plan has gloss.
struct alignas(64) Gloss {
  Lane<float> own;  // 1: by the roughness there; 0: the material says how much it mirrors, or light passes it
  Lane3 albedo;     // share of light from all sides that the highlight sends to the viewer
  Lane<float> held_back;  // of that, what a dielectric keeps from its diffuse layer
  Lane<float> again;      // of the lobe, (1 - E) / E: light that meets the surface more than once
  // Where the plan filters the environment: what the highlight shows of it where nothing hides it, and what
  // it shows of light from all sides by what probes know.
  Lane3 shine, around;
};

// Surfaces that a batch of rays hit, and the light that they send back along the ray.
struct alignas(64) HitBatch {
  Lane3 position;          // metres from the anchor
  Lane3 normal;            // for shading, unit, on the viewer's side
  Lane3 geometric_normal;  // unit, on the viewer's side
  Lane3 viewer;            // towards the viewer, unit
  Lane<float> offset;      // metres along the geometric normal at which secondary rays start
  Lane3 diffuse;           // albedo
  Lane3 f0;                // specular reflectance at normal incidence
  Lane<float>
      held_back;       // with probes or gloss: what a dielectric keeps from its diffuse layer, its largest F0
  Lane<float> alpha2;  // GGX alpha squared
  Lane3 emission;      // radiance
  Lane<float> mirror;  // share of the mirror ray that is seen, but for what reflects of it
  Lane<float> transmission;   // share of the light that passes the surface
  Lane<float> index_ratio;    // refractive index of the viewer's side over that of the other
  Lane<float> dielectric_f0;  // reflectance of the bare interface at normal incidence
  Lane3 tint;                 // colour of light that passes
  Lane<float> is_catcher;     // 1 on a catcher, even where it is seen as an object
  // With textures or voxels: width of the ray, metres, and what it grows by per metre.
  Lane<float> cone_width, cone_spread;
  // With surface details: what a blended surface covers, 1 elsewhere; specular reflectance at grazing angles.
  Lane<float> coverage, f90;
  // Share of light from all sides that reaches the surface by its occlusion texture; 1 without one.
  Lane<float> occlusion;
  // Of the transparent body behind the surface: what light loses in it per metre, -ln(colour) / distance.
  Lane3 absorption;
  // How fast the shading normal turns along the surface, radians per metre: what a ray's width spreads over.
  Lane<float> curvature;
  Lane<std::int32_t> kind;  // HitKind
  Lane<std::uint32_t> key;  // random numbers: frame, eye and sample
  // Objects: radiance by direct light. Catchers: irradiance with all objects in place, and without them.
  Lane3 direct, direct_without;
  // With probes: mean radiance from all sides (irradiance / pi) of light that came by other surfaces; of
  // catchers also without the virtual objects.
  Lane3 indirect, indirect_without;
  // Share of short rays that meet nothing; of catchers also without the virtual objects.
  Lane<float> open, open_without;
  Lane3 mirrored;  // catchers: reflection of virtual objects, added to the feed
  // Which 4x4 block of the tile the sample lies in. Last of the lanes: bytes would leave those behind
  // unaligned.
  Lane<std::uint8_t> block;
  Lane<std::uint8_t> rank;              // of 16, by its place in the block (rank_of_place)
  std::unique_ptr<FurtherLobes> lobes;  // where the plan has further lobes
  std::unique_ptr<Gloss> gloss;         // where the plan has gloss
};

// Rays that wait to be traced, dense, and which hit of the batch each belongs to.
struct alignas(64) RayQueue {
  Lane3 origin, direction;
  Lane<std::int32_t> hit;
  int count = 0;
  std::uint32_t salt = 0;  // tells their random numbers from those of other rays of the same hits
};

// What rays to a lamp's strata saw: how many were blocked, and the sums of the places of those (of each axis,
// ShadingPoints::stratum_at). Lane: a value per hit, or per place of a tile.
template <typename LaneType>
struct BlockedSums {
  LaneType count;
  std::array<LaneType, 3> places;
};

// What adaptive samples know of the hits of a tile, where these lie in it, with a margin without hits.
struct TilePlaces {
  static constexpr int kMargin = 1, kStride = kTileSide + 2 * kMargin;
  using Plane = std::array<float, static_cast<std::size_t>(kStride* kStride + kMaxLanes)>;
  static std::size_t place(int x, int y) {
    return static_cast<std::size_t>((y + kMargin) * kStride + x + kMargin);
  }
  Plane kind;            // HitKind; 0 where there is none, or none whose rays others may take
  Plane wanted, enough;  // 1: takes the rays of its window; finds enough there
  std::array<Plane, 3> position, normal;
  std::array<Plane, 3> all_places;  // the sums of the places of all rays
  BlockedSums<Plane> blocked, blocked_without;
  BlockedSums<Plane> seen, seen_without;  // VisibleFit
};

// What is known of a light at each hit while its samples are adaptive. Only where asked for.
struct alignas(64) AdaptiveLight {
  Lane<std::int32_t> start;               // at which strata it begins (direct_light/rotated_strata-inl.h)
  Lane<float> faced, seen, seen_without;  // numbers of the first rays
  Lane<float> faces;                      // 1: has a ray in the round in work
  Lane<float> mixed;                      // 1: the first rays of its block disagree
  Lane<float> asks;                       // 1: needs more rays of its own
  Lane<float> smoothed;                   // 1: takes the rays of its window
  Lane<float> shiny;                      // 1: has a highlight that outshines matte surfaces
  Lane<float> by_samples;                 // 1: shaded sample by sample; 0: by points
  BlockedSums<Lane<float>> blocked, blocked_without;  // of all rays; of smoothed hits the window's fit
  // Where the vectors begin that are looked at.
  std::array<std::int16_t, kTileRays / 4 + 1> open_slots;
  std::size_t open_count = 0;
  std::span<const std::int16_t> open() const { return std::span(open_slots).first(open_count); }
  TilePlaces places;
};

// What the layers of blended surfaces add up to, front to back, per first hit.
struct alignas(64) AlphaLayers {
  Lane3 light, ratio;       // as in texels
  Lane<float> through;      // share of what is behind that is seen
  Lane<std::int32_t> kind;  // HitKind of the first layer
};

// Rays through glass and off it that wait to be traced, first come, first served: those that took the same
// way from neighbouring samples stay together.
inline constexpr int kMostPending = 6 * kTileRays;
struct alignas(64) PendingRays {
  template <typename T>
  using Queue = std::array<T, kMostPending + kMaxLanes>;
  struct Queue3 {
    Queue<float> x, y, z;
  };
  Queue3 origin, direction;
  Queue3 weight;             // share of what they bring that is seen
  Queue3 medium;             // what light loses per metre on their way
  Queue<float> width;        // of their cones where they start
  Queue<std::int32_t> path;  // as SecondRays::path
  int begin = 0, end = 0;    // those that wait
  int budget = 0;            // how many more of them may be traced
};

// What second rays show of the camera feed, in front of the catchers' ratio; of those that leave the scene
// outside the camera's view, the environment.
struct alignas(64) ShownFeed {
  Lane3 radiance;
};

// Rays that first hits send on, and what those meet. All but `hits` per ray in work.
struct alignas(64) SecondRays {
  HitBatch hits;
  Lane<std::int32_t> sender;  // the first hit that sent it
  Lane3 weight;               // share of what it brings that is seen
  Lane3 medium;               // only with glass, as PendingRays::medium
  Lane<std::int32_t> path;    // only with glass: sender, and the way since (lighting/onward_rays-inl.h)
  std::unique_ptr<PendingRays> pending;  // only with glass
  std::unique_ptr<ShownFeed> feed;       // only where they show the camera feed
};

// One worker's memory for the tile in work. What only some scenes need is there where the plan asks for it
// (Renderer::Impl::allocate_scratch), after the lanes, which it would shift.
struct alignas(64) TileScratch {
  alignas(64) unsigned char packets[sizeof(RTCRayHit16) * kTileRays / 16];  // of whichever width
  std::array<std::int32_t, kTileRays / 4> packet_x, packet_y;
  alignas(64) std::array<std::array<std::int32_t, kMaxLanes>, kTileRays / 4> packet_valid;
  HitBatch first;
  RayQueue queue;
  Lane<float> visible, visible_without;     // of the light sample in work, per hit
  std::unique_ptr<SecondRays> second;       // where surfaces mirror or let light through
  std::unique_ptr<RayQueue> blocked;        // where catchers shadow one another: blocked rays of catchers
  std::unique_ptr<AlphaLayers> layers;      // where surfaces blend
  std::unique_ptr<AdaptiveLight> adaptive;  // where light samples are adaptive
  std::unique_ptr<EdgeSamples> edges;       // where further rays go through samples at edges
};

// Counts of one worker; added up after the frame.
struct alignas(64) TileCounters : FrameCounters {};

// What is the same for all tiles of a frame.
struct ShadingInputs {
  const FramePlan* plan = nullptr;
  RTCScene scene = nullptr;
  std::span<const InstanceRecord> instances;
  std::span<const LightRecord> lights;
  std::span<const ShadingPoints> points;      // one of each light
  const ProbeView* probes = nullptr;          // null without probes
  const ProbeView* catcher_probes = nullptr;  // what catchers alone send to one another; null without
  float ambient[3] = {};
  int occlusion_rays = 0;
  float occlusion_radius_m = 0;
  bool occlusion_smoothing = true;
  EnvironmentRecord environment_map;  // instead of `environment` where it has texels
  FilteredRecord filtered;            // of that, where the plan filters it
  float environment[3] = {};
  float smallest_irradiance[3] =
      {};  // below this a catcher is too dark for a ratio: its feed is kept as it is
  float largest_ratio = kLargestRatio;     // of catchers; 1 where no feed is there that could grow brighter
  bool background_is_environment = false;  // no feed to show: misses return the environment, opaque
  float see_through[3] = {};               // radiance that stands for the feed, where it is painted
  bool paints_see_through = false;         // over whatever would show the feed: opaque
  bool paints_catchers = false;            // over catchers alone
  bool debug_tiles = false;
  float shown_white = 1;  // radiance that is shown as white: what is painted, not lit, has colours times it
};

struct TileJob {
  const RayGrid* grid = nullptr;
  const ShadingInputs* shading = nullptr;
  int x0 = 0, y0 = 0;  // first column and row of the tile
  TileScratch* scratch = nullptr;
  TileCounters* counters = nullptr;
  StageCycles* cycles = nullptr;
  RayRecorder* recorder = nullptr;  // bench only: takes a copy of every ray
};

// Takes one tile through all its stages.
using TraceTile = void (*)(const TileJob&);
TraceTile trace_tile_for(Isa isa);

}  // namespace herr
