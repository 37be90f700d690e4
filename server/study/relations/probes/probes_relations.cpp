// Light that probes gather over time: memory of 0 and nearly all, lights that are switched, steps of any
// length.
#include <algorithm>
#include <cmath>
#include <glm/ext/scalar_constants.hpp>
#include <limits>
#include <memory>

#include "server/study/relations/one_albedo.h"
#include "server/study/relations/picture_distance.h"
#include "server/study/relations/probes/probe_memory.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "server/study/report/figure_text.h"

namespace herr {
namespace {

constexpr int kProbeFrames = 16;  // dark probes fall asleep after as many, and then take other steps
constexpr float kWhite = 0.99f;
constexpr double kDarkShare = 1e-6;     // of the brightest: below it nothing is told apart
constexpr double kDark_w_m2 = 1e-7;     // above what lets a probe sleep
constexpr double kPublished = 0x1p-14;  // light is read with 13 bits of mantissa, rounded to nearest
constexpr double kSums = 0x1p-15;       // of 64 rays in float, a fifth root and a fifth power
constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr std::int64_t kDarkHour_ns = 3'600'000'000'000;

double dark_floor(double most) {
  return std::max(kDarkShare * most, kDark_w_m2);
}

double fifth_root_of(double light) {
  return std::pow(light, 0.2);
}
double fifth_power_of(double fifth_root) {
  return fifth_root * fifth_root * fifth_root * fifth_root * fifth_root;
}

// The largest of many errors and where it was; what is no number is as large as can be.
struct WorstProbe {
  double error = 0;
  std::string where;
  std::size_t index = 0;

  void offer(double value, std::size_t at, int probes, double got, double wanted) {
    if (!(value <= kUnbounded)) value = kUnbounded;
    if (value <= error) return;
    error = value, index = at;
    where = probe_place(at, probes) + ": " + figure(got, 6) + " W/m^2, not " + figure(wanted, 6);
  }
};

std::vector<ProbeLight> first_light(ProbeMemory& memory) {
  std::vector<ProbeLight> out(kProbeFrames);
  for (int frame = kProbeFrames - 1; frame >= 0; --frame) {  // each is earlier than the last: another run
    memory.step(memory.at(frame));
    out[static_cast<std::size_t>(frame)] = memory.light();
  }
  return out;
}

// Albedo 0.99. `first`: what each frame would bring to probes that know nothing.
struct WhiteRun {
  std::string name;
  double kept = 0;  // a frame
  bool react = false, switched = false;
};

void measure_white(const WhiteRun& run, ProbeMemory& memory, const std::vector<ProbeLight>& first,
                   RelationLog& log) {
  Relation relation;
  relation.name = run.name;
  relation.holds = "a bounce gives at most 0.99 of the brightest light before it";
  relation.bound = 2 * kPublished + kSums;
  relation.unit = "relative excess over the most that a step of the exact solution can leave";
  relation.bound_from = "light before and after is read with 13 bits (2^-14 each), sums of floats add 2^-15";

  const double surroundings = brightest_surroundings(memory.subject().scene);
  WorstProbe worst;
  ProbeLight before(first[0].size(), 0.0f);
  for (int frame = 0; frame < kProbeFrames; ++frame) {
    memory.step(memory.at(frame), !run.switched || frame % 2 == 0);
    const ProbeLight now = memory.light();
    const double bounced = double{kWhite} * std::max(brightest(before), surroundings);
    const double kept = frame == 0 ? 0 : run.kept, floor = dark_floor(brightest(now));
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double newest = double{first[static_cast<std::size_t>(frame)][i]} + bounced,
                   old = double{before[i]};
      const double most =
          run.react ? std::max(old, newest)
                    : fifth_power_of(kept * fifth_root_of(old) + (1 - kept) * fifth_root_of(newest));
      worst.offer((double{now[i]} - most) / std::max(most, floor), i, memory.probes(), double{now[i]}, most);
    }
    before = now;
  }
  const PictureDistance bad =
      values_not_finite(memory.picture(memory.at(kProbeFrames)), memory.subject().profile);
  if (bad.error > 0) worst.error = kUnbounded, worst.where = bad.where;
  log.measured(relation, worst.error, worst.where);
}

void measure_white_rooms(const RelationCase& own, RelationLog& log) {
  const RelationCase white = of_albedo(own, kWhite);
  const auto with = [&](double tau_s, bool react) {
    RelationCase subject = white;
    subject.settings.probes.hysteresis_tau_s = tau_s;
    subject.settings.probes.react = react;
    return subject;
  };
  const double tau_s = -1 / (white.profile.display_hz * std::log(0.999));
  ProbeMemory none(with(0, false));
  const std::vector<ProbeLight> first = first_light(none);
  measure_white({"memory of 0, albedo 0.99", 0, false, false}, none, first, log);
  ProbeMemory nearly_all(with(tau_s, false));
  measure_white({"memory of 0.999 a frame, albedo 0.99", 0.999, false, false}, nearly_all, first, log);
  ProbeMemory reacting(with(own.settings.probes.hysteresis_tau_s, true));
  measure_white({"switched lights, albedo 0.99, reaction on", 0, true, true}, reacting, first, log);
}

// Where radiance is 1 all around, the next frame's is 0.01 + 0.99 times 1. Less is no fault: a surface that
// no probe sees well is darker.
void measure_probe_furnace(const RelationCase& own, RelationLog& log) {
  Relation relation;
  relation.name = "furnace of albedo 0.99";
  relation.holds =
      "among surfaces that emit 0.01 and reflect 0.99, probes that know radiance 1 know no more of it "
      "afterwards: bounces add up to 100 times the first and no more";
  relation.bound = kProbeFrames * (kPublished + kSums) + kPublished;
  relation.unit = "relative excess";
  relation.bound_from =
      "each of 16 bounces reads light with 13 bits (2^-14) and sums floats (2^-15); a bounce that gave 0.1 % "
      "too much would be off by 1.5 %";
  RelationCase first = own;
  first.settings.probes.hysteresis_tau_s = 0;
  ProbeMemory glowing(furnace_case(first, 0)), white(furnace_case(first, kWhite));
  glowing.step(glowing.at(0));
  white.renderer().restore(glowing.renderer().state());
  const double all = glm::pi<double>();
  WorstProbe worst;
  for (int frame = 1; frame <= kProbeFrames; ++frame) {
    white.step(white.at(frame));
    const ProbeLight now = white.light();
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double got = double{now[i]};
      worst.offer(got / all - 1, i, white.probes(), got, all);
    }
  }
  log.measured(relation, worst.error, worst.where);
}

enum class Switching : std::uint8_t { on, off, switched };

std::vector<ProbeLight> light_of_frames(ProbeMemory& memory, Switching lights) {
  std::vector<ProbeLight> out;
  for (int frame = 0; frame < kProbeFrames; ++frame) {
    memory.step(memory.at(frame),
                lights == Switching::on || (lights == Switching::switched && frame % 2 == 0));
    out.push_back(memory.light());
  }
  return out;
}

void measure_switched(ProbeMemory& memory, RelationLog& log) {
  Relation relation;
  relation.name = "lights switched each frame";
  relation.holds = "light off and on again leaves no less than always off and no more than always on";
  relation.bound = kProbeFrames * 2 * kPublished;
  relation.unit = "relative excess";
  relation.bound_from =
      "updates are convex and rise with the light: each of 16 may add one step of 13 bits (2^-13)";
  const std::vector<ProbeLight> on = light_of_frames(memory, Switching::on),
                                off = light_of_frames(memory, Switching::off);
  if (on == off) {
    const bool none = memory.subject().scene.lights.empty();
    log.not_applicable(relation, none ? "no light" : "no light of its lights reaches a probe");
    return;
  }
  const std::vector<ProbeLight> switched = light_of_frames(memory, Switching::switched);
  WorstProbe worst;
  for (std::size_t frame = 0; frame < kProbeFrames; ++frame) {
    const double floor = dark_floor(brightest(on[frame]));
    for (std::size_t i = 0; i < on[frame].size(); ++i) {
      const double most = double{on[frame][i]}, least = double{off[frame][i]},
                   got = double{switched[frame][i]};
      worst.offer((got - most) / std::max(most, floor), i, memory.probes(), got, most);
      worst.offer((least - got) / std::max(least, floor), i, memory.probes(), got, least);
    }
  }
  log.measured(relation, worst.error, worst.where);
}

void measure_same_time(ProbeMemory& memory, RelationLog& log) {
  Relation relation;
  relation.name = "the same time twice";
  relation.holds = "a step of no time changes nothing that probes remember, even with the lights switched";
  relation.unit = "bytes that differ";
  relation.bound_from = "exp(-0) keeps all of it: the very bytes";
  memory.step(memory.at(0));
  memory.step(memory.at(1));
  const std::vector<std::byte> once = memory.renderer().state().probes;
  memory.step(memory.at(1), false);
  const std::vector<std::byte> twice = memory.renderer().state().probes;
  double differ = once.size() == twice.size() ? 0 : kUnbounded;
  for (std::size_t i = 0; i < std::min(once.size(), twice.size()); ++i) differ += once[i] != twice[i] ? 1 : 0;
  log.measured(relation, differ);
}

// What is left of the light that `memory` has now, after `steps` steps of `step_ns` in the dark.
WorstProbe forgetting(ProbeMemory& memory, ProbeMemory& dark, TimeNs begin_ns, int steps, TimeNs step_ns) {
  const double tau_s = dark.subject().settings.probes.hysteresis_tau_s;
  const ProbeLight before = memory.light();
  dark.renderer().restore(memory.renderer().state());
  for (int step = 1; step <= steps; ++step) dark.step(begin_ns + step * step_ns);
  const ProbeLight after = dark.light();
  const double passed_s = static_cast<double>(steps) * static_cast<double>(step_ns) * kSecondsPerNs;
  const double left = tau_s > 0 ? std::exp(-5 * passed_s / tau_s) : 0, floor = dark_floor(brightest(before));
  WorstProbe worst;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!(double{before[i]} >= floor)) continue;
    const double wanted = left * double{before[i]}, got = double{after[i]};
    const double of = left > 1e-20 ? wanted : double{before[i]};
    worst.offer(std::abs(got - wanted) / of, i, memory.probes(), got, wanted);
  }
  return worst;
}

void measure_forgetting(ProbeMemory& memory, RelationLog& log) {
  const double tau_s = memory.subject().settings.probes.hysteresis_tau_s;
  Relation relation;
  relation.unit = "relative error";
  relation.bound = 2 * kPublished + 0x1p-16;
  relation.bound_from =
      "light before and after is read with 13 bits (2^-14 each); 16 steps round 5 floats each";
  memory.step(memory.at(0));
  for (int frame = 1; frame < kProbeFrames; ++frame) memory.step(memory.at(frame));
  ProbeMemory dark(without_light(memory.subject()));
  const auto sixteenth_ns = static_cast<TimeNs>(std::llround(tau_s * 1e9 / 16));
  WorstProbe worst;
  for (const int steps : {1, 4, 16}) {
    WorstProbe one = forgetting(memory, dark, memory.at(kProbeFrames - 1), steps, 16 / steps * sixteenth_ns);
    one.where = std::to_string(steps) + (steps == 1 ? " step, " : " steps, ") + one.where;
    if (one.error > worst.error) worst = one;
  }
  relation.name = "memory of probes does not depend on the step";
  relation.holds = "a time constant in the dark leaves exp(-5) of the light, in 1 step, 4 or 16";
  log.measured(relation, worst.error, worst.error > 0 ? worst.where : std::string());
  relation.name = "an hour in the dark in one step";
  relation.holds = "probes keep exp(-dt / tau), to the fifth power in light, however long the step";
  const WorstProbe hour = forgetting(memory, dark, memory.at(kProbeFrames - 1), 1, kDarkHour_ns);
  log.measured(relation, hour.error, hour.where);
}

}  // namespace

void measure_probes(const RelationCase& subject, RelationLog& log) {
  RelationCase own = probe_case(subject);
  if (own.settings.probes.hysteresis_tau_s <= 0) {
    own.settings.probes.hysteresis_tau_s = ProbeSettings{}.hysteresis_tau_s;
  }
  const std::string left_out = why_left_out(plan_of(own), "probes");
  if (!left_out.empty()) {
    Relation relation;
    relation.name = "memory of probes";
    relation.holds = "light that probes gather stays bounded, and is forgotten by the exact solution";
    log.not_applicable(relation, left_out);
    return;
  }
  measure_white_rooms(own, log);
  measure_probe_furnace(own, log);
  ProbeMemory memory(own);
  measure_switched(memory, log);
  measure_same_time(memory, log);
  measure_forgetting(memory, log);
}

}  // namespace herr
