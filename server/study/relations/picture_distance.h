// How far two pictures of the same viewports lie apart, for relations. Values that are no numbers are as far
// as can be. Before: picture_of. After: groups of relations.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/study/error/linear_picture.h"
#include "server/study/relations/relation.h"
#include "sessions/format/display_profile.h"

namespace herr {

struct PictureDistance {
  double error = 0;   // of all viewports together
  std::string where;  // the pixel that is farthest off; empty where none is
  std::size_t viewport = 0;
};

// Share of pixels of which some colour lies more than one step of 8-bit sRGB off, of values limited to white.
PictureDistance share_beyond_one_step(const std::vector<LinearPicture>& got,
                                      const std::vector<LinearPicture>& wanted,
                                      const DisplayProfile& profile);
// Largest |got - wanted| / max(|wanted|, floor), where floor is `floor_share` of the largest value of
// `wanted`.
PictureDistance largest_relative(const std::vector<LinearPicture>& got,
                                 const std::vector<LinearPicture>& wanted, double floor_share,
                                 const DisplayProfile& profile);
// Largest |got - wanted| / (sum + least): of pictures that are sums, `sum` of the sizes of what is added.
PictureDistance largest_of_sum(const std::vector<LinearPicture>& got,
                               const std::vector<LinearPicture>& wanted,
                               const std::vector<LinearPicture>& sum, double least,
                               const DisplayProfile& profile);
// Number of values that differ in any bit, +0 and -0 apart.
PictureDistance differing_values(const std::vector<LinearPicture>& got,
                                 const std::vector<LinearPicture>& wanted, const DisplayProfile& profile);
// Root mean square of the differences, values limited to white.
double rms_difference(const std::vector<LinearPicture>& got, const std::vector<LinearPicture>& wanted);
// Values that are NaN or infinite.
PictureDistance values_not_finite(const std::vector<LinearPicture>& got, const DisplayProfile& profile);

// The viewport that `distance` found worst, limited to white.
RelationPictures worst_pictures(const PictureDistance& distance, const std::vector<LinearPicture>& got,
                                const std::vector<LinearPicture>& wanted, std::string caption);

}  // namespace herr
