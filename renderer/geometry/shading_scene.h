// The scene as the shading kernels read it: plain records, one per triangle, instance, texture
// and light. Positions are float, relative to the anchor. Instance index = Embree instance id;
// one material per instance.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/model/scene.h"

namespace herr {

// 32 bytes, one gather base per hit: what Embree's primID leads to.
struct alignas(32) TriangleRecord {
  std::uint32_t normal[3];  // octahedral, two 16-bit snorms: x low, y high
  std::uint32_t uv[3];      // two 16-bit unorms over the mesh's uv range: u low, v high
  float texel_density = 0;  // area in coordinates over area in object space, 1/m^2
  // Turn of the shading normal along the surface, radians per unit of object space: a float but for its last
  // 8 bits. In these n: places on the triangle are rounded as a float near 2^(n - 127) is, off its plane and
  // in object space; 0: not at all.
  std::uint32_t curvature_and_rounding = 0;
};
static_assert(sizeof(TriangleRecord) == 32);

// Linear RGBA of a triangle's corners, two 16-bit unorms a word: R low and G high, B low and A high.
struct alignas(32) ColourRecord {
  std::uint32_t rgba[6] = {};
  std::uint32_t unused[2] = {};
};
static_assert(sizeof(ColourRecord) == 32);

// Tangents of a triangle's corners, for its normal texture. 16 bytes.
struct alignas(16) TangentRecord {
  std::uint32_t tangent[3] = {};  // octahedral, as TriangleRecord::normal
  float handedness = 1;           // bitangent = handedness * cross(normal, tangent)
};
static_assert(sizeof(TangentRecord) == 16);

inline constexpr int kMostLevels = 15;  // 16384 texels down to 1

struct TextureRecord {
  const std::uint32_t* rgba8 = nullptr;  // R in the low byte; level behind level
  int width = 0, height = 0;             // of level 0; level n has max(1, width >> n)
  bool srgb = true;
  std::uint8_t wrap_u = 0, wrap_v = 0;  // TextureWrap
  bool nearest = false;                 // magnified texels stay squares
  int levels = 1;
  std::array<std::int32_t, kMostLevels> first_texel{};  // of each level
};

// A texture where an instance uses it, with the coordinates that it reads.
struct TextureUse {
  const TextureRecord* texture = nullptr;       // null: none
  const TriangleRecord* coordinates = nullptr;  // one per triangle; only uv and texel_density
  float uv_lower[2] = {}, uv_scale[2] = {};     // uv = lower + scale * unorm
};

// Lobes beyond diffuse and one round highlight: factors and their textures. By default there is none.
struct LobeRecord {
  float coat = 0, coat_roughness = 0, coat_normal_scale = 1;
  float sheen[3] = {}, sheen_roughness = 0;
  float stretch = 0, stretch_cos = 1, stretch_sin = 0;  // the angle from the tangent, counter-clockwise
  TextureUse coat_texture, coat_roughness_texture, sheen_texture, sheen_roughness_texture, stretch_texture;
  TextureUse coat_normal;  // with DetailRecord::tangents
};
inline constexpr LobeRecord kNoLobes{};

// What most instances do without; only where a material or mesh asks for it.
struct DetailRecord {
  const ColourRecord* colours = nullptr;  // of vertices, one per triangle
  // The two base textures stand here instead of in the instance's record where they read a second set.
  TextureUse base_colour, metallic_roughness, emission, specular_use, specular_colour, transmission;
  TextureUse normal;                        // with `tangents`
  const TangentRecord* tangents = nullptr;  // one per triangle; null: no normal texture and no stretch
  float normal_scale = 1;
  TextureUse occlusion;
  float occlusion_strength = 1;
  LobeRecord lobes;
  TextureUse coverage;  // alpha = that of the base colour texture, wherever that stands
  float specular = 1, specular_rgb[3] = {1, 1, 1};
  float alpha = 1, alpha_cutoff = 0.5f;
  AlphaMode alpha_mode = AlphaMode::opaque;
  bool unlit = false;
};

struct InstanceRecord {
  const TriangleRecord* triangles = nullptr;  // null unless of kind mesh
  float normal_from_object[9] = {};           // rows of the inverse transpose of the object's matrix
  float uv_lower[2] = {}, uv_scale[2] = {};   // uv = lower + scale * unorm
  float base_colour[3] = {};
  float metallic = 0, roughness = 1;
  float mirror = 0;  // share of the mirror ray that is seen; below 0: by the roughness of each place
  float transmission = 0, refractive_index = 1.5f;
  float dielectric_f0 = 0.04f;  // ((n - 1) / (n + 1))^2; 1 of index 0 alone
  float absorption[3] = {};     // of the body behind the surface, per metre
  float emission[3] = {};
  const TextureRecord* base_colour_texture = nullptr;
  const TextureRecord* metallic_roughness_texture = nullptr;
  // Secondary rays start at least this far off; off a mesh, this times 2^(n - 127) of the triangle.
  float least_offset_m = 0;
  float object_rounding = 0;             // the same in object space
  const DetailRecord* detail = nullptr;  // null: nothing more
  float object_per_world2 = 1;           // squared length in object space of a metre (mean over directions)
  // Of a matrix that stretches: over the length of normal_from_object * n, the area in object space of a
  // square metre of a face with the unit normal n there. 0: object_per_world2 holds for all faces.
  float face_per_world2 = 0;
  bool back_face_culling = false;  // eyes do not see its back faces
  bool catcher = false;
  ShapeKind kind = ShapeKind::mesh;
};

inline constexpr int kMostOrderedSamples = 256;

struct LightRecord {
  LightKind kind = LightKind::box;
  bool is_virtual = false;  // catchers receive it with the virtual objects in place, and not without them
  float centre[3] = {};
  float lower[3] = {}, size[3] = {};      // the box, for stratified samples
  float intensity[3] = {};                // W/sr; of a sun W/m^2
  float min_distance2 = 0;                // (half the longest edge)^2: the falloff's floor
  float half_turn_m = 0;                  // over the distance: what half vectors turn by across a stratum
  float inverse_range2 = 0;               // 1 / (distance where the light ends)^2; 0: it never ends
  float direction[3] = {};                // in which a spot or sun shines, unit
  float cone_scale = 0, cone_offset = 1;  // of a spot: brightness clamp(scale cos + offset)^2
  float reach = 0;            // metres that leave the scene from anywhere in it: twice its diagonal
  std::uint32_t key = 0;      // random numbers: which light
  int samples = 1;            // the product of the strata
  int first_samples = 1;      // of these, traced for every hit (LightSampling::first)
  int strata[3] = {1, 1, 1};  // per axis
  bool stratified = true;     // false: every sample lies anywhere on the light
  bool in_middles = false;    // samples lie in the middles of their strata
  // With first_samples < samples: strata as adaptive samples look at them (direct_light/strata_order.h).
  std::array<std::int32_t, kMostOrderedSamples> order{};
};

// A lamp as few points stand for it (direct_light/shading_points.h).
inline constexpr int kMostShadingPoints = 8;
struct ShadingPoints {
  LightRecord light;  // as the lamp, with the points for its samples
  // Along each axis, where strata and points lie: from the lamp's middle, over the root mean square of its
  // light.
  std::array<std::array<float, kMostOrderedSamples>, 3> stratum_at{};
  std::array<std::array<float, kMostShadingPoints>, 3> point_at{};
  float nearest2 = 0;  // squared distance below which a lamp is too near for its points
};

}  // namespace herr
