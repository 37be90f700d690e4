// Quality that follows load and motion: loads that step, times that are none, smoothing over any step.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "server/quality/deadline_policy.h"
#include "server/quality/motion_policy.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_case.h"
#include "server/study/relations/relation_groups.h"

namespace herr {
namespace {

constexpr double kLoadStep = 50;         // by which the load steps
constexpr double kSettling_s = 20;       // of frames: more than all waits for more light together
constexpr std::int64_t kRaysEach = 500;  // of a column; of a sample; of a probe
constexpr TimeNs kAnHour_ns = 3'600'000'000'000;

// What frames cost in full, as shares of the target.
struct SteppingLoad {
  double fixed = 0.0025, columns = 0.2, light = 0.2475, probes = 0.05;
};

// A machine on which a frame costs what its quality says, times a factor; nobody waits for its clock.
class CountedMachine {
 public:
  explicit CountedMachine(const DeadlineConfig& config) : config_(config), policy_(config) {}

  FrameCost cost_of(const FrameQuality& quality, double factor) const {
    const FrameQuality& full = config_.limits.full;
    FrameCost cost;
    cost.quality = quality;
    cost.total_ms = factor * load_.fixed * config_.target_ms;
    const auto add = [&](WorkKind kind, double share, std::int64_t units, std::int64_t of) {
      const auto k = static_cast<std::size_t>(kind);
      cost.rays[k] = kRaysEach * units;
      if (of > 0)
        cost.work_ms[k] =
            factor * share * config_.target_ms * static_cast<double>(units) / static_cast<double>(of);
      cost.total_ms += cost.work_ms[k];
    };
    const auto samples = [](const FrameQuality& of) {
      return std::int64_t{of.polar_width} * of.polar_height;
    };
    add(WorkKind::eye, load_.columns, samples(quality), samples(full));
    add(WorkKind::light, load_.light, samples(quality) * quality.light_samples,
        samples(full) * full.light_samples);
    add(WorkKind::probe, load_.probes, quality.probes, full.probes);
    cost.missed = cost.total_ms > config_.target_ms;
    return cost;
  }
  // True: in time.
  bool frame(double factor) {
    const FrameCost cost = cost_of(decide(), factor);
    observe(cost, std::llround(1e6 * std::max(cost.total_ms, config_.target_ms)));
    return !cost.missed;
  }
  const FrameQuality& decide() {
    decision_ = policy_.decide(config_.limits.full);
    return decision_.quality;
  }
  void observe(FrameCost cost, TimeNs after_ns) {
    cost.finished_ns = now_ns_ += after_ns;
    policy_.observe(cost);
  }
  bool is_sound() const {
    const QualityLimits& limits = config_.limits;
    const FrameQuality& quality = decision_.quality;
    const auto within = [](int value, int least, int most) { return value >= least && value <= most; };
    return within(quality.polar_width, limits.narrowest, limits.full.polar_width) &&
           within(quality.polar_height, limits.lowest, limits.full.polar_height) &&
           quality.polar_height % 2 == 0 && within(quality.light_samples, 1, limits.full.light_samples) &&
           within(quality.probes, limits.fewest_probes, limits.full.probes) &&
           std::isfinite(policy_.headroom()) && decision_.aim_ms.value_or(0) > 0 &&
           std::isfinite(decision_.predicted_ms.value_or(0));
  }
  bool is_full() const {
    const FrameQuality &a = decision_.quality, &b = config_.limits.full;
    return same(a, b);
  }
  static bool same(const FrameQuality& a, const FrameQuality& b) {
    return a.polar_width == b.polar_width && a.polar_height == b.polar_height &&
           a.light_samples == b.light_samples && a.probes == b.probes;
  }
  const QualityDecision& decision() const { return decision_; }
  const DeadlineConfig& config() const { return config_; }
  int settling_frames() const { return static_cast<int>(std::ceil(kSettling_s * 1e3 / config_.target_ms)); }

 private:
  const DeadlineConfig config_;
  const SteppingLoad load_;
  DeadlinePolicy policy_;
  QualityDecision decision_;
  TimeNs now_ns_ = 0;
};

// As wide and high, as many samples and probes as the run has, down to one column of a quarter of the rows.
DeadlineConfig config_of(const RelationCase& subject) {
  const RenderSettings& settings = subject.settings;
  DeadlineConfig config;
  config.target_ms = 1000 / subject.profile.display_hz;
  const auto& counts = subject.scene.probes.counts;
  const int probes = settings.probes.on ? counts[0] * counts[1] * counts[2] : 0;
  const FrameQuality full{settings.light_samples, settings.polar_width, probes, settings.polar_height};
  config.limits = quality_limits(full, 1, default_lowest(settings.polar_height));
  return config;
}

// Steps of light samples and probes from everything down to the least.
int steps_of_effort(const QualityLimits& limits) {
  int steps = 0;
  for (int samples = limits.full.light_samples; samples > 1; samples = (samples + 1) / 2) ++steps;
  for (int probes = limits.full.probes; probes > limits.fewest_probes; probes /= 2) ++steps;
  return steps;
}

void measure_load_steps(const DeadlineConfig& config, RelationLog& log) {
  Relation up, down, calm;
  up.name = "a load that rises to 50 times";
  up.holds = "of all frames after the step only the first, which could not know of it, misses the target";
  up.unit = "frames from the second on until all are in time";
  up.bound_from = "a frame beyond 4 deviations of its forecast is believed whole: the next one fits";
  down.name = "a load that falls to a 50th";
  down.holds = "no frame is late, and all quality is back after the controller's own waits";
  down.unit = "frames until all quality is back";
  const double wait_frames = std::ceil(config.more_light_after_s * 1e3 / config.target_ms) + 1;
  const QualityLimits& limits = config.limits;
  const double growth = double(limits.full.polar_width) * limits.full.polar_height / limits.lowest;
  down.bound = 1 + config.hold_frames + std::ceil(std::log(growth) / std::log(config.growth)) +
               steps_of_effort(limits) * wait_frames;
  down.bound_from =
      "1 frame that meets the step, 2 of hold, a doubling a frame, and half a second for each step of "
      "samples "
      "and probes";
  calm.name = "no limit cycle under a steady load";
  calm.holds = "width, height, light samples and probes stay as they are once they have settled";
  calm.unit = "frames of another quality than the one before";
  calm.bound_from =
      "what fits is a fixed number under a steady load, and 2 % more or 1 % less change nothing";

  CountedMachine machine(config);
  const FrameQuality floor{1, limits.narrowest, limits.fewest_probes, limits.lowest};
  const bool reachable = machine.cost_of(floor, kLoadStep).total_ms <= config.target_ms / 1.1;
  const int frames = machine.settling_frames();
  double changes = 0;
  const auto run_calmly = [&](double factor) {
    for (int i = 0; i < frames; ++i) machine.frame(factor);
    for (int i = 0; i < frames; ++i) {
      const FrameQuality before = machine.decision().quality;
      machine.frame(factor);
      const FrameQuality& now = machine.decision().quality;
      changes += CountedMachine::same(before, now) ? 0 : 1;
    }
  };
  run_calmly(1);
  int last_late = 0, last_less = 0;
  for (int i = 1; i <= frames; ++i) {
    if (!machine.frame(kLoadStep)) last_late = i;
  }
  run_calmly(kLoadStep);
  for (int i = 1; i <= frames; ++i) {
    if (!machine.frame(1)) last_less = std::numeric_limits<int>::max();
    if (!machine.is_full()) last_less = std::max(last_less, i);
  }
  run_calmly(3);
  if (reachable) {
    log.measured(up, std::max(0, last_late - 1));
  } else {
    log.not_applicable(up, "polar buffers of " + std::to_string(limits.full.polar_width) + " columns and " +
                               std::to_string(limits.full.polar_height) + " rows cannot shrink 50 times");
  }
  log.measured(down, last_less);
  log.measured(calm, changes);
}

void measure_any_times(const DeadlineConfig& config, RelationLog& log) {
  constexpr double kForever = std::numeric_limits<double>::infinity(),
                   kNone = std::numeric_limits<double>::quiet_NaN();
  Relation relation;
  relation.name = "frames that never end, clocks that jump";
  relation.holds =
      "after frames that never end or take no time, and clocks that jump, quality stays in its ranges, "
      "forecasts "
      "are finite, and 50 frames later all are in time";
  relation.unit = "decisions";
  relation.bound_from = "none may leave its range";
  CountedMachine machine(config);
  const double target = config.target_ms;
  double bad = 0;
  for (const double total_ms : {kForever, -kForever, kNone, 0.0, -1.0, 1e300, 5e-324, 50 * target}) {
    for (const TimeNs after_ns :
         {TimeNs{0}, TimeNs{1}, kAnHour_ns, -kAnHour_ns, TimeNs{std::llround(1e6 * target)}}) {
      for (int i = 0; i < 8; ++i) {
        FrameCost cost = machine.cost_of(machine.decide(), 1);
        bad += machine.is_sound() ? 0 : 1;
        cost.total_ms = total_ms;
        if (i % 2 == 1) cost.work_ms.fill(total_ms);
        machine.observe(cost, after_ns);
      }
      for (int i = 0; i < 100; ++i) {
        const bool in_time = machine.frame(1);
        bad += machine.is_sound() && (in_time || i < 50) ? 0 : 1;
      }
    }
  }
  log.measured(relation, bad);
}

// What a policy of one width expects of the next frame after `steps` frames of `cost_ms` in `span_ns`.
double expected_after(const DeadlineConfig& of_run, double before_ms, double cost_ms, TimeNs span_ns,
                      int steps) {
  DeadlineConfig config = of_run;
  config.limits = quality_limits({1, of_run.limits.full.polar_width, 0}, of_run.limits.full.polar_width);
  DeadlinePolicy policy(config);
  TimeNs now_ns = 0;
  const auto observe = [&](double ms) {
    FrameCost cost;
    cost.quality = policy.decide(config.limits.full).quality;
    cost.total_ms = ms;
    cost.work_ms[static_cast<std::size_t>(WorkKind::eye)] = 0.75 * ms;
    cost.rays[static_cast<std::size_t>(WorkKind::eye)] = kRaysEach * cost.quality.polar_width;
    cost.finished_ns = now_ns;
    policy.observe(cost);
  };
  observe(before_ms);
  for (int i = 0; i < steps; ++i) {
    now_ns += span_ns / steps;
    observe(cost_ms);
  }
  return policy.decide(config.limits.full).predicted_ms.value_or(std::numeric_limits<double>::quiet_NaN());
}

void measure_smoothing(const DeadlineConfig& config, RelationLog& log) {
  constexpr int kMostSteps = 256;
  Relation relation;
  relation.name = "smoothed costs do not depend on the step";
  relation.holds = "costs that rose or fell near their new value by exp(-T / tau), in 1 step, 16 or 256 of T";
  relation.unit = "relative error";
  relation.bound = kMostSteps * 8 * 0x1p-53;
  relation.bound_from = "256 steps round two parts 4 times each, by 2^-53";
  const double before_ms = 0.5 * config.target_ms;
  double worst = 0;
  for (const double factor : {1.02, 0.98}) {  // within what is noise
    const double tau_s = factor > 1 ? config.rise_tau_s : config.fall_tau_s, now_ms = factor * before_ms;
    for (const TimeNs span_ns : {TimeNs{0}, TimeNs{256}, TimeNs{256'000'000}, kAnHour_ns}) {
      const double wanted =
          now_ms + (before_ms - now_ms) * std::exp(-static_cast<double>(span_ns) * kSecondsPerNs / tau_s);
      for (const int steps : {1, 16, kMostSteps}) {
        const double error =
            std::abs(expected_after(config, before_ms, now_ms, span_ns, steps) - wanted) / wanted;
        if (!(error <= worst)) worst = error;
      }
    }
  }
  log.measured(relation, worst);
}

void measure_motion(const DeadlineConfig& config, RelationLog& log) {
  Relation relation;
  relation.name = "quality by motion, from rest to any speed";
  relation.holds = "width and light samples stay in their ranges and never rise with the speed";
  relation.unit = "decisions";
  relation.bound_from = "none may leave its range or exceed the one of a slower head";
  const QualityLimits& limits = config.limits;
  const MotionConfig motion;
  FrameQuality before = limits.full;
  double bad = 0;
  for (const double deg_s : {0.0, 5e-324, 1.0, motion.still_deg_s, 1.0001 * motion.still_deg_s,
                             std::sqrt(motion.still_deg_s * motion.fast_deg_s), motion.fast_deg_s,
                             20 * motion.fast_deg_s, 1e9, 1e308, std::numeric_limits<double>::infinity()}) {
    const FrameQuality quality = quality_for_motion({deg_s / 57.29577951308232, 0}, limits).quality;
    const bool sound = quality.polar_width >= limits.narrowest && quality.light_samples >= 1 &&
                       quality.polar_width <= before.polar_width &&
                       quality.light_samples <= before.light_samples && quality.probes == before.probes;
    bad += sound ? 0 : 1;
    before = quality;
  }
  log.measured(relation, bad);
}

}  // namespace

void measure_control(const RelationCase& subject, RelationLog& log) {
  measure_prediction(subject, log);
  const std::string no_polar = why_left_out(plan_of(subject), "log-polar rays");
  if (!no_polar.empty()) {
    Relation relation;
    relation.name = "width control";
    relation.holds = "quality stays in its ranges whatever frames cost, and settles after a step of the load";
    log.not_applicable(relation, no_polar);
    return;
  }
  const DeadlineConfig config = config_of(subject);
  measure_load_steps(config, log);
  measure_any_times(config, log);
  measure_smoothing(config, log);
  measure_motion(config, log);
}

}  // namespace herr
