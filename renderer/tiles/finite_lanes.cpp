#include "renderer/tiles/finite_lanes.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace herr {
namespace {

// Looks at lanes until it has found something.
class FiniteSearch {
 public:
  // Of objects and catchers, or of catchers alone.
  FiniteSearch(const HitBatch& hits, int count) : hits_(hits), count_(static_cast<std::size_t>(count)) {}

  void look(const Lane<float>& lane, const std::string& name, bool catchers_alone = false) {
    for (std::size_t i = 0; found_.empty() && i < count_; ++i) {
      const auto kind = static_cast<HitKind>(hits_.kind[i]);
      const bool asked = kind == HitKind::catcher || (kind == HitKind::object && !catchers_alone);
      if (!asked || std::isfinite(lane[i])) continue;
      found_ = name + " of hit " + std::to_string(i) + " is " + std::to_string(lane[i]);
    }
  }
  void look(const Lane3& lanes, const std::string& name, bool catchers_alone = false) {
    look(lanes.x, name + ".x", catchers_alone);
    look(lanes.y, name + ".y", catchers_alone);
    look(lanes.z, name + ".z", catchers_alone);
  }
  const std::string& found() const { return found_; }

 private:
  const HitBatch& hits_;
  std::size_t count_;
  std::string found_;
};

void look_at_surfaces(const HitBatch& hits, const FramePlan& plan, FiniteSearch& search) {
  search.look(hits.position, "position");
  search.look(hits.normal, "normal");
  search.look(hits.geometric_normal, "geometric_normal");
  search.look(hits.viewer, "viewer");
  search.look(hits.offset, "offset");
  search.look(hits.diffuse, "diffuse");
  search.look(hits.f0, "f0");
  search.look(hits.alpha2, "alpha2");
  search.look(hits.emission, "emission");
  search.look(hits.mirror, "mirror");
  search.look(hits.curvature, "curvature");
  search.look(hits.index_ratio, "index_ratio");
  if (plan.probes) search.look(hits.held_back, "held_back");
  if (plan.textures || plan.voxels) search.look(hits.cone_width, "cone_width");
  if (plan.surface_details) {
    search.look(hits.coverage, "coverage");
    search.look(hits.f90, "f90");
    search.look(hits.occlusion, "occlusion");
  }
  if (plan.refraction) {
    search.look(hits.transmission, "transmission");
    search.look(hits.dielectric_f0, "dielectric_f0");
    search.look(hits.tint, "tint");
    search.look(hits.absorption, "absorption");
  }
  if (!hits.lobes || !plan.further_lobes) return;
  search.look(hits.lobes->coat, "coat");
  search.look(hits.lobes->coat_alpha2, "coat_alpha2");
  search.look(hits.lobes->coat_normal, "coat_normal");
  search.look(hits.lobes->sheen, "sheen");
  search.look(hits.lobes->sheen_alpha, "sheen_alpha");
  search.look(hits.lobes->tangent, "tangent");
  search.look(hits.lobes->stretch, "stretch");
}

void look_at_light(const HitBatch& hits, const FramePlan& plan, FiniteSearch& search) {
  search.look(hits.direct, "direct");
  if (plan.catchers) search.look(hits.direct_without, "direct_without", true);
}

void look_at_indirect(const HitBatch& hits, const FramePlan& plan, FiniteSearch& search) {
  if (hits.gloss && plan.filtered_environment) {
    search.look(hits.gloss->shine, "shine");
    search.look(hits.gloss->around, "around");
  }
  if (!plan.probes) return;
  search.look(hits.indirect, "indirect");
  if (plan.catcher_probes) search.look(hits.indirect_without, "indirect_without", true);
}

}  // namespace

std::string first_not_finite(const HitBatch& hits, int count, Stage stage, const FramePlan& plan) {
  FiniteSearch search(hits, count);
  switch (stage) {
    case Stage::surfaces:
    case Stage::second_hits:
    case Stage::probe_rays:
      look_at_surfaces(hits, plan, search);
      break;
    case Stage::light_rays:
      look_at_light(hits, plan, search);
      break;
    case Stage::occlusion:
      search.look(hits.open, "open");
      if (plan.catchers) search.look(hits.open_without, "open_without", true);
      break;
    case Stage::indirect_light:
      look_at_indirect(hits, plan, search);
      break;
    case Stage::second_light:  // of first hits, to whose light it was added
      look_at_light(hits, plan, search);
      if (plan.catcher_mirrors) search.look(hits.mirrored, "mirrored", true);
      break;
    default:
      throw std::logic_error(std::string("the stage ") + name_of(stage) + " fills no lanes of hits");
  }
  return search.found();
}

std::string first_not_finite(std::span<const float> numbers, const std::string& what) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (std::isfinite(numbers[i])) continue;
    return what + ", number " + std::to_string(i) + " is " + std::to_string(numbers[i]);
  }
  return {};
}

std::string first_not_finite(std::span<const std::uint16_t> halfs, const std::string& what) {
  constexpr std::uint16_t kAllExponent = 0x7c00;  // set in NaN and infinite halfs alone
  for (std::size_t i = 0; i < halfs.size(); ++i) {
    if ((halfs[i] & kAllExponent) != kAllExponent) continue;
    return what + ", half " + std::to_string(i) + " is not finite";
  }
  return {};
}

void require_none(Stage stage, const std::string& found) {
  if (!found.empty()) throw std::logic_error(std::string("stage ") + name_of(stage) + ": " + found);
}

}  // namespace herr
