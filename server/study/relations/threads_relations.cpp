// The same picture by any number of threads, again, after a restart, and by each instruction set.
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <thread>

#include "server/study/relations/picture_distance.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "server/study/relations/rounding_share.h"

namespace herr {
namespace {

constexpr int kWarmFrames = 4;  // in which probes gather light of as many bounces
constexpr double kFewThreadProbes = 1024;

// Everything random is asked at once: probes, adaptive samples, occlusion rays; the feed as the run has it.
RelationCase everything_random(RelationCase subject) {
  const bool camera = subject.camera, shown = subject.settings.camera;
  subject = all_light(std::move(subject));
  subject.camera = camera, subject.settings.camera = shown;
  subject.settings.light_samples = 16;
  subject.settings.adaptive_min_samples = 4;
  return subject;
}

RelationCase with_few_probes(RelationCase subject) {
  const auto& counts = subject.scene.probes.counts;
  double& density = subject.settings.probes.density;
  density = std::min(density, std::cbrt(kFewThreadProbes / (double(counts[0]) * counts[1] * counts[2])));
  return subject;
}

struct TwoFrames {
  std::vector<LinearPicture> first, second;
};

TimeNs thread_period_ns(const RelationCase& subject) {
  return static_cast<TimeNs>(1e9 / subject.profile.display_hz);
}

// What a picture by a renderer asks of its case: all but the scene.
RelationCase moment_of(const RelationCase& subject) {
  RelationCase moment;
  moment.state = subject.state, moment.sample = subject.sample;
  return moment;
}

// After a few frames that probes take up: the frame of the case, and one display period later.
TwoFrames two_frames(Renderer& renderer, const RelationCase& subject) {
  RelationCase then = moment_of(subject);
  for (int k = kWarmFrames; k > 0; --k) {
    then.sample.t_ns = subject.sample.t_ns - k * thread_period_ns(subject);
    renderer.skip_frame(then.sample, then.state);
  }
  TwoFrames out;
  then.sample.t_ns = subject.sample.t_ns;
  out.first = next_picture(renderer, then);
  then.sample.t_ns = subject.sample.t_ns + thread_period_ns(subject);
  out.second = next_picture(renderer, then);
  return out;
}

// One renderer at a time: the fewest threads of all that live are what each gets.
TwoFrames two_frames(const RelationCase& subject) {
  Renderer renderer(subject.scene, subject.profile, subject.settings, subject.camera);
  return two_frames(renderer, subject);
}

// Takes the worse of what was compared.
struct SamePictures {
  PictureDistance worst;
  std::optional<RelationPictures> pictures;

  void compare(const std::vector<LinearPicture>& got, const std::vector<LinearPicture>& wanted,
               const DisplayProfile& profile, const std::string& what) {
    PictureDistance apart = differing_values(got, wanted, profile);
    if (apart.error <= worst.error) return;
    apart.where = what + ": " + apart.where;
    pictures = worst_pictures(apart, got, wanted, what + " | as it was | difference");
    worst = std::move(apart);
  }
};

void measure_again(const RelationCase& random, RelationLog& log) {
  Relation twice, restarted;
  twice.name = "a frame twice";
  twice.holds = "the same moment again is the same picture, bit for bit";
  twice.unit = restarted.unit = "values that differ";
  twice.bound_from = "no time has passed: nothing that is carried from frame to frame may change";
  restarted.name = "a frame after a restart";
  restarted.holds = "after a restart the same frames come as from a new renderer, bit for bit";
  restarted.bound_from = "a restart leaves nothing behind";
  Renderer renderer(random.scene, random.profile, random.settings, random.camera);
  const TwoFrames first = two_frames(renderer, random);
  RelationCase then = moment_of(random);
  then.sample.t_ns += thread_period_ns(random);
  SamePictures again, anew;
  again.compare(next_picture(renderer, then), first.second, random.profile, "again");
  log.measured(twice, again.worst.error, again.worst.where, again.pictures);
  renderer.restart(random.state);
  const TwoFrames restarts = two_frames(renderer, random);
  anew.compare(restarts.first, first.first, random.profile, "first frame");
  anew.compare(restarts.second, first.second, random.profile, "next frame");
  log.measured(restarted, anew.worst.error, anew.worst.where, anew.pictures);
}

void measure_thread_counts(RelationCase random, RelationLog& log) {
  Relation relation;
  relation.name = "the same bytes by any number of threads";
  relation.holds = "1, 2, 3 threads and all of this machine give the same picture, bit for bit";
  relation.unit = "values that differ";
  relation.bound_from =
      "random numbers follow time, eye, place and sample, and sums the order of tiles: no bit changes";
  std::vector<int> counts{2, 3};
  if (std::thread::hardware_concurrency() > 3) counts.push_back(0);  // all
  random.settings.threads = 1;
  const TwoFrames one = two_frames(random);
  SamePictures same;
  for (const int threads : counts) {
    random.settings.threads = threads;
    const TwoFrames got = two_frames(random);
    const std::string what = (threads == 0 ? "all" : std::to_string(threads)) + " threads";
    same.compare(got.first, one.first, random.profile, what);
    same.compare(got.second, one.second, random.profile, what + ", next frame");
  }
  log.measured(relation, same.worst.error, same.worst.where, same.pictures);
}

std::vector<Isa> isas_here() {
  std::vector<Isa> isas;
  for (const Isa isa : {Isa::sse4, Isa::avx2, Isa::avx512}) {
    try {
      resolve_isa(isa);
      isas.push_back(isa);
    } catch (const std::invalid_argument&) {  // this CPU lacks it
    }
  }
  return isas;
}

// The picture by the first set, and the one by another that is farthest from it.
TwinPictures farthest_apart(const std::vector<Isa>& isas, RelationCase subject) {
  TwinPictures worst;
  double error = -1;
  std::vector<LinearPicture> wanted;
  for (const Isa isa : isas) {
    subject.settings.isa = isa;
    std::vector<LinearPicture> got = two_frames(subject).first;
    if (wanted.empty()) {
      wanted = std::move(got);
      continue;
    }
    const double apart = share_beyond_one_step(got, wanted, subject.profile).error;
    if (apart <= error) continue;
    error = apart;
    worst.names = std::string(name_of(isa)) + " | " + name_of(isas.front());
    worst.got = std::move(got);
  }
  worst.wanted = std::move(wanted);
  return worst;
}

void measure_isas(const RelationCase& lit, RelationLog& log) {
  Relation relation;
  relation.name = "the same picture by each instruction set";
  relation.holds = "sse4, avx2 and avx512, as this machine has them, differ by rounding alone";
  relation.bound = 1e-3;
  relation.unit = "share of pixels beyond one 8-bit step";
  relation.bound_from =
      "rounding (2^-24) turns only rays that pass an edge as closely; half-float texels round once more";
  const std::vector<Isa> isas = isas_here();
  if (isas.size() < 2) {
    log.not_applicable(relation, "this machine has one of them");
    return;
  }
  const auto draw = [](const RelationCase& any) { return two_frames(any).first; };
  RoundedRelation asked{.relation = std::move(relation),
                        .caption = {},
                        .twins = [&](const RelationCase& any) { return farthest_apart(isas, any); },
                        .likeness = {},
                        .draw = draw};
  measure_but_for_rounding(std::move(asked), lit, farthest_apart(isas, lit), log);
}

}  // namespace

void measure_threads(const RelationCase& subject, RelationLog& log) {
  const RelationCase random = with_few_probes(everything_random(subject));
  measure_thread_counts(random, log);
  measure_again(random, log);
  measure_isas(with_few_probes(all_light(subject)), log);
}

}  // namespace herr
