// More samples change the noise, not the mean: light samples up: no bias, less noise.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "server/study/relations/light/plain_scene.h"
#include "server/study/relations/light/seed_means.h"
#include "server/study/relations/picture_distance.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"

namespace herr {
namespace {

constexpr int kSeeds = 16, kMoreSeeds = 48;
constexpr std::uint32_t kFurther = 1000;  // from seeds to others
constexpr std::array<int, 4> kLightSamples{2, 4, 16, 64};
constexpr int kReferenceSamples = 64, kCalmSamples = 256, kUsualFirstStrata = 8;
constexpr std::array<int, 4> kOcclusionRays{1, 2, 4, 8};
constexpr int kReferenceOcclusionRays = 16, kCalmOcclusionRays = 64;
constexpr std::size_t kMostLights = 2;
constexpr double kStandardErrors = 4;
// Sample and pixel of two pictures, rounded to half floats by at most 2^-11 of them.
constexpr double kRounding = 0x1p-9;
constexpr const char* kNothingLit = "no light reaches what is seen";
constexpr const char* kNoExtent = "no light that shines has an extent";

// Half the rays per axis: many pictures are made.
void halve(RelationCase& subject) {
  for (Viewport& viewport : subject.profile.viewports) {
    viewport.width_px = std::max(1, viewport.width_px / 2);
    viewport.height_px = std::max(1, viewport.height_px / 2);
  }
  subject.settings.polar_width = std::max(1, subject.settings.polar_width / 2);
  subject.settings.polar_height = std::max(2, subject.settings.polar_height / 4 * 2);
  subject.settings.polar_acuity = false;
}

RelationCase matte_case(const RelationCase& subject) {
  RelationCase matte = hard_light(subject);
  show_plainly(matte);
  make_matte(matte.scene);
  make_environment_black(matte.scene);  // of which catchers show a ratio of lights, not their sum
  halve(matte);
  return matte;
}

// Values of one seed in a row, each over what a picture of little noise shows there, or its mean where that
// is darker: bright places count no more than others.
class Rows {
 public:
  explicit Rows(const std::vector<LinearPicture>& typical) {
    double sum = 0;
    for_each_value(typical, [&](float value) {
      sum += double{value};
      weight_.push_back(value);
    });
    const auto mean = static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(1, weight_.size())));
    lit_ = mean > 0;
    for (float& weight : weight_) weight = lit_ ? 1 / std::max(weight, mean) : 0;
  }
  bool lit() const { return lit_; }

  // Of seeds [first, first + count); `mean` becomes the mean picture.
  SeedRows of(const RelationCase& subject, std::uint32_t first, int count,
              std::vector<LinearPicture>& mean) const {
    const auto renderer = renderer_of(subject);
    next_picture(*renderer, subject);
    SeedRows rows(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto pictures = picture_of_seed(*renderer, subject, first + static_cast<std::uint32_t>(i));
      for_each_value(pictures, [&](float value) { rows[i].push_back(value * weight_[rows[i].size()]); });
      add_share(mean, pictures, 1.0f / static_cast<float>(count));
    }
    return rows;
  }

 private:
  template <typename Visit>
  static void for_each_value(const std::vector<LinearPicture>& pictures, const Visit& visit) {
    for (const LinearPicture& picture : pictures) {
      for (const auto& plane : picture.plane) std::for_each(plane.begin(), plane.end(), visit);
    }
  }
  static void add_share(std::vector<LinearPicture>& mean, const std::vector<LinearPicture>& pictures,
                        float share) {
    const bool first = mean.empty();
    if (first) mean = pictures;
    for (std::size_t v = 0; v < pictures.size(); ++v) {
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < pictures[v].pixels(); ++i) {
          mean[v].plane[c][i] = (first ? 0.0f : mean[v].plane[c][i]) + pictures[v].plane[c][i] * share;
        }
      }
    }
  }

  std::vector<float> weight_;
  bool lit_ = false;
};

struct Measured {
  RelationCase subject;
  std::uint32_t first_seed = 0;
  SeedRows rows;
  std::vector<LinearPicture> mean;
};
Measured measure(const Rows& rows, RelationCase subject, std::uint32_t first_seed, int seeds = kSeeds) {
  Measured out{std::move(subject), first_seed, {}, {}};
  out.rows = rows.of(out.subject, first_seed, seeds, out.mean);
  return out;
}

Relation unbiased(std::string name, std::string holds) {
  Relation relation;
  relation.name = std::move(name);
  relation.holds = std::move(holds);
  relation.kind = RelationKind::statistical;
  relation.bound = kStandardErrors;
  relation.unit = "standard errors";
  relation.bound_from =
      "the mean over 16 seeds, or 48 others where those are beyond it; values may differ by 2^-9 of "
      "themselves, which rounding to half floats "
      "explains";
  return relation;
}

void log_difference(const Relation& relation, const Rows& rows, const Measured& tested,
                    const Measured& reference, RelationLog& log) {
  const double error = mean_difference(tested.rows, reference.rows, kRounding).worst();
  if (error > kStandardErrors && tested.rows.size() == kSeeds) {
    // Few seeds of rare bright samples scatter more than they tell: others decide.
    log_difference(relation, rows, measure(rows, tested.subject, tested.first_seed + kFurther, kMoreSeeds),
                   measure(rows, reference.subject, reference.first_seed + kFurther, kMoreSeeds), log);
    return;
  }
  const PictureDistance farthest = largest_relative(tested.mean, reference.mean, 0.1, tested.subject.profile);
  log.measured(relation, error, farthest.where,
               worst_pictures(farthest, tested.mean, reference.mean,
                              "mean over seeds | mean of the reference | difference"));
}

// With `samples` of each light, strata that are all asked, or independent places.
RelationCase sampled(RelationCase subject, int samples, LightSampler sampler) {
  subject.settings.light_samples = samples;
  subject.settings.light_sampler = sampler;
  return subject;
}

// At most two lights with extent, others off. Their number.
std::size_t keep_soft_lights(RelationCase& subject) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < subject.state.lights.size(); ++i) {
    const AreaLight& light = subject.state.lights[i];
    const bool soft = light.kind != LightKind::sun && light.size != glm::vec3(0.0f) &&
                      light.intensity_w_sr != glm::vec3(0.0f);
    if (soft && kept++ < kMostLights) continue;
    subject.state.lights[i].intensity_w_sr = subject.scene.lights[i].intensity_w_sr = glm::vec3(0.0f);
  }
  return std::min(kept, kMostLights);
}

Relation same_mean(int samples) {
  const std::string n = std::to_string(samples);
  return unbiased(
      "mean with " + n + " light samples",
      n + " samples in strata of each soft light have the mean that independent places on it have, "
          "on matte surfaces");
}

// Strata of 4 N lie within those of N: the variance within them is no greater, and that of their mean is 1/4.
Relation less_noise() {
  Relation relation;
  relation.name = "noise of 4 times the light samples";
  relation.holds = "strata of 4 N samples scatter half as much as those of N, or less";
  relation.kind = RelationKind::statistical;
  relation.bound = kStandardErrors;
  relation.unit = "standard errors";
  relation.bound_from =
      "the standard errors of both scatters over 16 seeds; rounding to half floats may add 2^-10 of the "
      "values; where one sample scatters too, as outlines of voxels do, that of 64 samples is taken off "
      "first";
  return relation;
}

// Whether something beside lights is left to chance, as which voxels of a distant block rays meet.
bool other_chance(const Rows& rows, const RelationCase& soft) {
  const Measured hard = measure(rows, sampled(soft, 1, LightSampler::jittered), 1, 2);
  return hard.rows[0] != hard.rows[1];
}

struct Variance {
  double value = 0, standard_error = 0;
};

Variance variance_of(const SeedRows& rows) {
  const SeedNoise noise = seed_noise(rows);
  return {noise.sigma * noise.sigma, 2 * noise.sigma * noise.standard_error};
}

// With what scatters beside the light at any N in all three: A + B(N), where B(4 N) <= B(N) / 4. Taking off
// A + B(M) of a large M leaves B(4 N) - B(M) <= (B(N) - B(M)) / 4, which is looser by 3/4 of B(M) alone.
double noise_beyond_half(const SeedRows& few, const SeedRows& many, const Variance& beside) {
  const Variance whole = variance_of(few), quarter = variance_of(many);
  const double rounding = 0x1p-10 * mean_of(many);
  const double error =
      std::hypot(quarter.standard_error, whole.standard_error / 4, 0.75 * beside.standard_error);
  const double most = std::max(0.0, (whole.value - beside.value) / 4) + beside.value;
  const double excess = quarter.value - most - rounding * (rounding + 2 * std::sqrt(most));
  return excess > 0 ? excess / error : std::isnan(excess) ? excess : 0;
}

Relation adaptive_mean(const RelationCase& subject) {
  Relation relation =
      unbiased("mean with adaptive light samples",
               "a few strata first and more where they disagree: the mean of all strata, on matte surfaces");
  if (subject.settings.adaptive_min_samples == 0) relation.option = "adaptive light samples";
  return relation;
}

void measure_adaptive(const RelationCase& subject, const RelationCase& soft, const Rows& rows,
                      const Measured& all_strata, RelationLog& log) {
  RelationCase adaptive = sampled(soft, kReferenceSamples, LightSampler::jittered);
  const int asked = subject.settings.adaptive_min_samples;
  adaptive.settings.adaptive_min_samples = asked > 0 && asked < kReferenceSamples ? asked : kUsualFirstStrata;
  const std::string why = why_left_out(plan_of(adaptive), "adaptive light samples");
  if (!why.empty()) return log.not_applicable(adaptive_mean(subject), why);
  log_difference(adaptive_mean(subject), rows, measure(rows, adaptive, 201), all_strata, log);
}

void measure_light_samples(const RelationCase& subject, RelationLog& log) {
  RelationCase soft = matte_case(subject);
  const std::string no_light = soft.state.lights.empty()     ? why_left_out(plan_of(soft), "several lights")
                               : keep_soft_lights(soft) == 0 ? kNoExtent
                                                             : "";
  moderate_light(soft);
  const Rows rows(picture_of(sampled(soft, kCalmSamples, LightSampler::jittered)));
  const std::string why = !no_light.empty() ? no_light : rows.lit() ? "" : kNothingLit;
  if (!why.empty()) {
    for (const int samples : kLightSamples) log.not_applicable(same_mean(samples), why);
    log.not_applicable(less_noise(), why);
    log.not_applicable(adaptive_mean(subject), why);
    return;
  }
  const Measured reference = measure(rows, sampled(soft, kReferenceSamples, LightSampler::random), 101);
  std::map<int, Measured> tested;
  for (const int samples : kLightSamples) {
    tested[samples] = measure(rows, sampled(soft, samples, LightSampler::jittered), 1);
    log_difference(same_mean(samples), rows, tested[samples], reference, log);
  }
  // What one sample, the light's centre, leaves to chance scatters beside the light at any number.
  const bool scatters_beside = other_chance(rows, soft);
  const Variance beside = scatters_beside ? variance_of(tested[64].rows) : Variance{};
  const double beyond = noise_beyond_half(tested[4].rows, tested[16].rows, beside);
  log.measured(less_noise(), scatters_beside ? beyond
                                             : std::max(beyond, noise_beyond_half(tested[16].rows,
                                                                                  tested[64].rows, beside)));
  measure_adaptive(subject, soft, rows, tested[kReferenceSamples], log);
}

Relation same_occlusion(int rays) {
  const std::string n = std::to_string(rays);
  return unbiased(
      "mean with " + n + (rays == 1 ? " occlusion ray" : " occlusion rays"),
      n + " short rays per hit have the mean that 16 have, on matte surfaces under constant light");
}

void measure_occlusion(const RelationCase& subject, RelationLog& log) {
  RelationCase open = matte_case(subject);
  switch_lights_off(open);
  open.scene.ambient = glm::vec3(0.125f);
  open.settings.occlusion_rays = kCalmOcclusionRays;
  const Rows rows(picture_of(open));
  open.settings.occlusion_rays = kReferenceOcclusionRays;
  std::string why = why_left_out(plan_of(open), "ambient occlusion");
  if (why.empty() && !rows.lit()) why = kNothingLit;
  std::optional<Measured> reference;
  if (why.empty()) reference = measure(rows, open, 101);
  for (const int rays : kOcclusionRays) {
    if (!reference) {
      log.not_applicable(same_occlusion(rays), why);
      continue;
    }
    open.settings.occlusion_rays = rays;
    log_difference(same_occlusion(rays), rows, measure(rows, open, 1), *reference, log);
  }
}

}  // namespace

void measure_samples(const RelationCase& subject, RelationLog& log) {
  measure_light_samples(subject, log);
  measure_occlusion(subject, log);
}

}  // namespace herr
