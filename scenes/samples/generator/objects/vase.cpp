#include "scenes/samples/generator/objects/objects.h"
#include "scenes/samples/generator/pictures/textures.h"
#include "scenes/samples/generator/shapes/lathe.h"

namespace herr::samples {

GlbObject vase() {
  // From the middle of the base: foot ring, belly, neck, rolled lip, and down the inside to its floor.
  const std::vector<ProfilePoint> profile{
      {0.000f, 0.012f, true}, {0.105f, 0.012f, true}, {0.110f, 0.000f, true}, {0.128f, 0.000f, true},
      {0.132f, 0.020f, true}, {0.122f, 0.045f},       {0.128f, 0.085f},       {0.180f, 0.220f},
      {0.238f, 0.390f},       {0.262f, 0.550f},       {0.240f, 0.700f},       {0.175f, 0.810f},
      {0.118f, 0.880f},       {0.105f, 0.930f},       {0.118f, 0.985f},       {0.150f, 1.030f},
      {0.163f, 1.042f},       {0.160f, 1.052f},       {0.146f, 1.046f},       {0.112f, 0.990f},
      {0.096f, 0.930f},       {0.108f, 0.880f},       {0.164f, 0.805f},       {0.229f, 0.695f},
      {0.250f, 0.550f},       {0.226f, 0.390f},       {0.168f, 0.225f},       {0.100f, 0.070f},
      {0.000f, 0.045f, true}};
  const Mesh mesh = lathe(profile, {80, 4});
  return {"vase", {{mesh, {"porcelain", glm::vec3(1.0f), 0.0f, 0.2f, {}, porcelain_picture()}}}};
}

}  // namespace herr::samples
