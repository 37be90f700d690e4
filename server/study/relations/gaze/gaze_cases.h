// What gaze relations are asked of: gazes and displays at their limits, and a scene in which all that can be
// seen is white, so that a pixel is 1 whatever its weights, if they sum to 1 and their samples are there.
// Before: a relation case. After: gaze_relations.
#pragma once

#include <string>
#include <vector>

#include "server/study/relations/picture_distance.h"
#include "server/study/relations/relation_case.h"

namespace herr {

struct NamedGaze {
  std::string name;  // "at the middle of a viewport"
  SampledGaze gaze;
};

// In the middle of the first viewport of each eye, at its corner, 80 degrees off, behind the head, and lost.
std::vector<NamedGaze> gazes_at_limits(const RelationCase& subject);
// 16 of them, spread evenly within so many degrees of the sample's.
std::vector<SampledGaze> gazes_around(const FrameSample& sample, double within_deg);
// Of no direction: not a number, infinite, of no length.
std::vector<SampledGaze> gazes_of_no_direction();
// Straight ahead of each eye.
SampledGaze gaze_ahead(const FrameSample& sample);

// One viewport of the left eye, so many degrees across.
DisplayProfile single_viewport(double degrees, int pixels);

// The user's own surfaces, under light without chance; full meshes, since which coarser form is shown depends
// on the one before.
RelationCase own_surfaces(RelationCase subject);

// Every surface shows 1 and so does what lies behind, on every pixel, without a feed. Lights are left out:
// they would darken catchers.
RelationCase white_case(RelationCase subject);
// The same over nothing: colour is the coverage by surfaces.
RelationCase white_over_nothing(RelationCase subject);

// Largest |value - 1| of any channel, coverage among them.
PictureDistance farthest_from_white(const RenderedFrame& frame, const DisplayProfile& profile);
// Largest |colour - coverage|.
PictureDistance farthest_from_coverage(const RenderedFrame& frame, const DisplayProfile& profile);

// Radial and angular samples so dense that they lie no farther apart than pixels do anywhere in the display,
// but 8192 of each at most.
struct PolarSize {
  int width = 0, height = 0;
};
PolarSize finer_than_pixels(const RelationCase& subject);
// The same for single_viewport() and a gaze straight ahead to within so many degrees: of a viewport whose
// pixels are far finer along the radius than around.
PolarSize finer_than_pixels_ahead(double degrees, int pixels, double within_deg);
// Most that the settings allow, of each.
PolarSize largest_polar_size();

}  // namespace herr
