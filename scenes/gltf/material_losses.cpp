#include "scenes/gltf/material_losses.h"

#include <algorithm>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

// GGX of this roughness spreads light over less than half a degree: as good as sharp.
constexpr float kSharpest = 0.05f;
// From here on a highlight is too wide for a mirror to stand for it (material_builder's kRoughest).
constexpr float kDull = 0.35f;

}  // namespace

std::vector<std::string> material_losses(const GltfMaterial& from, const MeanRoughness& mean) {
  std::vector<std::string> lines;
  const auto say = [&](const std::string& text) {
    lines.push_back("material \"" + printable(from.name) + "\" " + text);
  };
  if (from.unlit) return lines;
  if (from.transmission > 0 && from.refractive_index > 0) {
    if (!from.has_thickness && from.refractive_index != 1)
      say("is glass without thickness, a thin wall: it is drawn as a solid body, which bends light");
    if (mean.surface > kSharpest)
      say("is rough glass: what is seen through it is sharp, and should be blurred");
  }
  const bool coat = from.coat > 0, sheen = from.sheen_colour != glm::vec3(0.0f);
  if (coat && mean.coat < kDull)
    say("has a smooth clear coat: it shows lamps, but mirrors nothing of what stands around it");
  if (coat || sheen) {
    const std::string layers = coat && sheen ? "clear coat and sheen" : coat ? "clear coat" : "sheen";
    say("has " + layers + ", which light between surfaces (--probes) leaves out");
  }
  return lines;
}

}  // namespace herr
