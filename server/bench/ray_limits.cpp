#include "server/bench/ray_limits.h"

#include <vector>

#include "server/text/number_text.h"

namespace herr {
namespace {

// Quotients of counts below 2^53: each is off by 2^-53 of itself, products of three by less than this.
constexpr double kRoundingSlack = 1e-12;

double per_sample(const BenchResult& result, const std::string& name) {
  for (const BenchResult::Kind& kind : result.kinds) {
    if (kind.name == name) return kind.rays_per_sample;
  }
  return 0;
}

double polar_samples(const BenchResult& result) {
  for (const BenchResult::Kind& kind : result.kinds) {
    if (kind.name == "primary") return static_cast<double>(kind.rays) / kind.rays_per_sample;
  }
  return 0;
}

}  // namespace

std::string rays_beyond_plan(const BenchResult& result, const FramePlan& plan, std::size_t lights,
                             const RenderSettings& settings) {
  // Of a sample that looks through blended surfaces, each layer has hits and second rays of its own.
  const double eye_layers = plan.alpha_blend ? kMostLayers : 1;
  // Further rays through edges are lit anew where no sample shows what they met; each side of a tile looks up
  // the samples beyond it, once for each of its own.
  const double edges = plan.edge_samples;
  const double layers = eye_layers * (1 + edges);
  const double per_hit = static_cast<double>(lights) * settings.light_samples;
  const double shadow = per_sample(result, "shadow"), mirror = per_sample(result, "mirror");
  const double mirror_shadow = per_sample(result, "mirror_shadow");
  const double refraction = per_sample(result, "refraction");
  const double refraction_shadow = per_sample(result, "refraction_shadow");
  const double occlusion = per_sample(result, "occlusion");
  // Every probe that is updated traces the rays that settings state; each hit asks for each light once.
  const double samples = polar_samples(result);
  const double probe_limit = samples > 0 ? static_cast<double>(result.most_probe_rays) / samples : 0.0;
  struct Limit {
    std::string name;
    double most;
  };
  // A second ray asks whether another catcher blocks; hits in mirrors and behind glass ask it too.
  const std::vector<Limit> limits{
      {"primary", 1.0},
      {"shadow", layers * per_hit},
      {"catcher_shadow", plan.catchers_occlude ? shadow + mirror_shadow + refraction_shadow : 0.0},
      {"mirror", plan.mirror_rays ? layers : 0.0},
      {"mirror_shadow", mirror * per_hit},
      {"refraction", plan.refraction ? layers * kMostGlassRays : 0.0},
      {"refraction_shadow", refraction * per_hit},
      {"occlusion", plan.occlusion ? layers * settings.occlusion_rays : 0.0},
      {"catcher_occlusion", plan.catchers_occlude ? occlusion : 0.0},
      {"probe", plan.probes ? probe_limit : 0.0},
      {"probe_shadow", per_sample(result, "probe") * static_cast<double>(lights)},
      {"catcher_probe", plan.catcher_probes ? probe_limit : 0.0},
      {"catcher_probe_shadow", per_sample(result, "catcher_probe") * static_cast<double>(lights)},
      {"behind", (eye_layers - 1) * (1 + edges)},
      {"edge", edges > 0 ? 4 + 2 * edges : 0.0},
      {"edge_shadow", edges * static_cast<double>(lights)}};
  for (const Limit& limit : limits) {
    const double traced = per_sample(result, limit.name);
    if (traced <= limit.most * (1 + kRoundingSlack)) continue;
    return "internal error: " + shortest_text(traced) + " " + limit.name +
           " rays per polar sample where the frame plan implies " + shortest_text(limit.most) +
           " at most; please report it";
  }
  return {};
}

}  // namespace herr
