// How far rays near a pixel's middle differ from the ray through it: what a picture may be off by that is
// made of samples as far apart as pixels. Before: a case of one ray per pixel. After: gaze_widths.
#pragma once

#include <vector>

#include "server/study/relations/relation_case.h"

namespace herr {

// Mean square, values limited to white, over rays that lie from the pixel's middle as bilinear weights of
// samples one pixel apart have them: along each axis up to a pixel away, with density 1 - |distance|. They
// pass anywhere, so that what repeats with the pixels is seen too. `middles` is the picture of `by_pixel`.
double mean_square_of_near_rays(const RelationCase& by_pixel, const std::vector<LinearPicture>& middles);

}  // namespace herr
