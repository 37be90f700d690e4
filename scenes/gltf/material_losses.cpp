#include "scenes/gltf/material_losses.h"

#include <algorithm>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

// GGX of this roughness spreads light over less than half a degree: as good as sharp.
constexpr float kSharpest = 0.05f;
// From here on a highlight is too wide for a mirror to stand for it (material_builder's kRoughest).
constexpr float kDull = 0.35f;

constexpr std::size_t kMostNames = 4;

}  // namespace

void MaterialLosses::say(const GltfMaterial& from, const std::string& text) {
  auto loss = std::find_if(losses_.begin(), losses_.end(), [&](const Loss& l) { return l.text == text; });
  if (loss == losses_.end()) loss = losses_.insert(loss, {text, {}});
  const std::string name = "\"" + printable(from.name) + "\"";
  if (std::find(loss->names.begin(), loss->names.end(), name) == loss->names.end())
    loss->names.push_back(name);
}

std::vector<std::string> MaterialLosses::lines() const {
  std::vector<std::string> lines;
  for (const Loss& loss : losses_) {
    std::string line = "material " + loss.names.front() + " " + loss.text;
    const std::size_t named = std::min(loss.names.size(), kMostNames);
    for (std::size_t i = 1; i < named; ++i) line += (i == 1 ? "; so with " : ", ") + loss.names[i];
    if (loss.names.size() > named) line += " and " + std::to_string(loss.names.size() - named) + " others";
    lines.push_back(line);
  }
  return lines;
}

void MaterialLosses::add(const GltfMaterial& from, const MeanRoughness& mean) {
  if (from.unlit) return;
  if (from.transmission > 0 && from.refractive_index > 0) {
    if (!from.has_thickness && from.refractive_index != 1)
      say(from, "is glass without thickness, a thin wall: it is drawn as a solid body, which bends light");
    if (mean.surface > kSharpest)
      say(from, "is rough glass: what is seen through it is sharp, and should be blurred");
  }
  const bool coat = from.coat > 0, sheen = from.sheen_colour != glm::vec3(0.0f);
  if (coat && mean.coat < kDull)
    say(from, "has a smooth clear coat: it shows lamps, but mirrors nothing of what stands around it");
  if (coat || sheen) {
    const std::string layers = coat && sheen ? "clear coat and sheen" : coat ? "clear coat" : "sheen";
    say(from, "has " + layers + ", which light between surfaces (probes) leaves out");
  }
}

}  // namespace herr
