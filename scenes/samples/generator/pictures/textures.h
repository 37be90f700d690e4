// The painted surfaces of the samples. All are sRGB pictures of at most 512 x 512 pixels.
#pragma once

#include "scenes/samples/generator/pictures/picture.h"

namespace herr::samples {

Picture wood_picture();       // grain along v, dark oak; repeats
Picture marble_picture();     // white with grey veins
Picture porcelain_picture();  // white and cobalt bands for the vase; u around, v down from the lip
Picture shell_picture();      // u around the tube, v along it from the tip
// An atlas in thirds of v: leaf (rib along u), terracotta, soil.
Picture plant_picture();
Picture planks_picture();  // floor boards along v, one picture is 2 m x 2 m; repeats
Picture rug_picture();     // a woven border and lozenges
Picture poster_picture();  // hills under a sun
Picture sky_picture();     // what the window shows
Picture books_picture();   // spines side by side

}  // namespace herr::samples
