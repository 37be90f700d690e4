// Changes to a case that leave one thing to be asked: surfaces without highlights, one albedo, no light,
// light of moderate strength. Before: RelationCase. After: relations about light, samples and surfaces.
#pragma once

#include "server/study/relations/relation_case.h"

namespace herr {

// Shown at 0 EV, bilinear (bicubic curves overshoot), without marker and debug colours; unlit surfaces are
// lit like all others.
void show_plainly(RelationCase& subject);
// No highlights, mirrors, glass, further lobes and occlusion textures, nothing is unlit: surfaces scatter
// evenly. Their colours, textures and holes stay.
void make_matte(Scene& scene);
// Matte, without holes, seen from both sides, of one albedo. Voxels keep their colours, times the albedo.
void paint_all(Scene& scene, float albedo);
// An eighth of the probes, with few rays, for what their noise does not change.
void trace_few_probe_rays(RenderSettings& settings);
// Catchers are not there.
void take_catchers_away(Scene& scene);

// Everything that shines, times `factor`: lights, emission, ambient light, the environment.
void scale_light(RelationCase& subject, float factor);
void switch_lights_off(RelationCase& subject);
void make_environment_black(Scene& scene);
void stop_emission(Scene& scene);

// Scales the light by a power of 2 such that the brightest value of a picture lies in [1/8, 1/4): far from
// where half floats end, above and below. Returns that picture's brightest value: 0 where it is black.
double moderate_light(RelationCase& subject);

// Values of 1/8 of a picture like that down to here keep 11 bits as half floats.
inline constexpr double kSmallestNormalHalf = 0x1p-14;
double largest_value(const std::vector<LinearPicture>& pictures);

}  // namespace herr
