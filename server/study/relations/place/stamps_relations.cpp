// When a session was recorded changes nothing: with stamps shifted by hours, to 0 and to the last legal one
// it reads the same and gives the same picture, bit for bit.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/document/parse_change.h"
#include "server/study/relations/picture_distance.h"
#include "server/study/relations/place/shifted_session.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "sessions/format/session_header.h"
#include "sessions/session.h"

namespace herr {
namespace {

constexpr int kReadings = 64;                    // frames that are sampled
constexpr TimeNs kHoursNs = 25'200'000'000'007;  // 7 hours and 7 ns
constexpr const char* kWhy =
    "stamps are integers, and only differences of them, taken before any rounding, are used";

struct Shift {
  const char* name;
  TimeNs shift_ns;
};

// By hours, so that the first stamp is 0, and so that the last one is the last that is legal.
std::vector<Shift> shifts_of(const StampSpan& span) {
  const bool has_room = span.last_ns <= kLastStampNs - kHoursNs;
  return {{"by 7 hours", has_room || span.first_ns < kHoursNs ? kHoursNs : -kHoursNs},
          {"to 0", -span.first_ns},
          {"to the last legal one", kLastStampNs - span.last_ns}};
}

void add(std::vector<double>& values, const Pose& pose) {
  const glm::dvec3& p = pose.position;
  const glm::dquat& q = pose.orientation;
  values.insert(values.end(), {p.x, p.y, p.z, q.x, q.y, q.z, q.w});
}

// All that a session says, its stamps as times since its start.
std::vector<double> readings_of(const std::filesystem::path& folder, const SessionOptions& reading) {
  Session session = Session::open(folder, reading);
  const TimeNs start_ns = session.start_ns(), length_ns = session.end_ns() - start_ns;
  const auto since_start = [&](TimeNs stamp_ns) { return static_cast<double>(stamp_ns - start_ns); };
  std::vector<double> values{static_cast<double>(length_ns)};
  for (int i = 0; i < kReadings; ++i) {
    const FrameSample sample = session.sample(start_ns + length_ns / kReadings * i);
    values.insert(values.end(), {since_start(sample.t_ns), since_start(sample.start_ns),
                                 since_start(sample.head.stamp_ns), static_cast<double>(sample.head.age_ns),
                                 sample.head_speed.turn_rad_s, sample.head_speed.move_m_s});
    add(values, sample.head.world_from_head);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const glm::dvec3& d = sample.gaze.head_direction[eye];
      values.insert(values.end(), {d.x, d.y, d.z, static_cast<double>(sample.gaze.source[eye])});
    }
    const bool seen = sample.gaze.stamp_ns != 0;  // 0: none was used
    values.push_back(seen ? since_start(sample.gaze.stamp_ns) : 0);
    values.push_back(static_cast<double>(sample.gaze.age_ns));
  }
  session.visit_events([&](const SceneEvent& event) {
    try {
      const SceneChange change = parse_event(event.json, session.events_file(), event.line, start_ns);
      values.insert(values.end(), {since_start(event.t_ns), change.time_s});
    } catch (const InputError&) {  // told when the session was opened
      if (!reading.keep_going) throw;
    }
  });
  return values;
}

double differing(const std::vector<double>& a, const std::vector<double>& b) {
  std::size_t count = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    count += std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i]) ? 1 : 0;
  }
  return static_cast<double>(count);
}

Relation of_values(std::string name, std::string holds, std::string unit) {
  Relation relation;
  relation.name = std::move(name);
  relation.holds = std::move(holds);
  relation.unit = std::move(unit);
  relation.bound_from = kWhy;
  return relation;
}

void measure_reading(const RelationCase& subject, const std::vector<Shift>& shifts, RelationLog& log) {
  const ShiftedSession as_it_is(subject.session, 0);
  const std::vector<double> wanted = readings_of(as_it_is.folder(), subject.reading);
  for (const Shift& shift : shifts) {
    const Relation relation = of_values(std::string("stamps shifted ") + shift.name + ", as read",
                                        "head, gaze and events are the same at the same time since the start",
                                        "values that differ");
    const ShiftedSession shifted(subject.session, shift.shift_ns);
    log.measured(relation, differing(readings_of(shifted.folder(), subject.reading), wanted));
  }
}

RelationCase shifted_case(RelationCase subject, TimeNs shift_ns) {
  FrameSample& sample = subject.sample;
  sample.t_ns += shift_ns, sample.start_ns += shift_ns;
  sample.head.stamp_ns += shift_ns, sample.gaze.stamp_ns += shift_ns;
  for (auto& camera : sample.cameras) {
    if (camera) camera->stamp_ns += shift_ns;
  }
  return subject;
}

void measure_pictures(const RelationCase& subject, const std::vector<Shift>& shifts, RelationLog& log) {
  const std::vector<LinearPicture> wanted = picture_of(subject);
  for (const Shift& shift : shifts) {
    const Relation relation = of_values(
        std::string("stamps shifted ") + shift.name + ", all light",
        "the picture is the same, bit for bit, with probes that gather every 10 us", "values that differ");
    const std::vector<LinearPicture> got = picture_of(shifted_case(subject, shift.shift_ns));
    const PictureDistance apart = differing_values(got, wanted, subject.profile);
    log.measured(relation, apart.error, apart.where,
                 worst_pictures(apart, got, wanted, relation.name + " | as it stands | difference"));
  }
}

}  // namespace

void measure_stamps(const RelationCase& subject, RelationLog& log) {
  const std::vector<Shift> shifts = shifts_of(stamps_of(subject.session));
  measure_reading(subject, shifts, log);
  RelationCase lit = all_light(subject);
  lit.settings.probes.density *= 0.5;  // an eighth of them: four pictures are made
  // What doubles round from late stamps, 512 ns, is a large share of so short a time.
  lit.profile.display_hz = 1e5;
  lit.settings.probes.hysteresis_tau_s = 2e-5;
  measure_pictures(lit, shifts, log);
}

}  // namespace herr
