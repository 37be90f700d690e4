#include "server/study/measure/study_frames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>

namespace herr {
namespace {

constexpr std::int64_t kMostMoments = 96;
constexpr double kDegrees = 57.29577951308232;

struct Moment {
  StudyFrame frame;
  double contrast = 0;
  double unrest_deg = std::numeric_limits<double>::infinity();  // of the gaze over the clip that begins here
};

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * kDegrees;
}

// Of the middle of both eyes' directions.
glm::dvec3 gaze_of(const FrameSample& sample) {
  return glm::normalize(sample.gaze.head_direction[0] + sample.gaze.head_direction[1]);
}

bool is_recorded(const FrameSample& sample) {
  return sample.gaze.source[0] != SampleSource::centred;
}

StudyFrame describe(const FrameStep& step, const FrameRange& range, std::int64_t number) {
  const FrameSample& sample = step.sample();
  return {number, static_cast<double>(sample.t_ns - range.session_start_ns) * 1e-9,
          sample.head_speed.turn_rad_s * kDegrees, degrees_between(gaze_of(sample), {0, 0, -1})};
}

// Largest change from one frame to the next, of the gaze against the head and of the gaze in the world.
double unrest_deg(FrameStep& step, std::int64_t first, std::int64_t count) {
  double most = 0;
  glm::dvec3 last_gaze{0, 0, -1}, last_world{0, 0, -1};
  for (std::int64_t i = 0; i < count; ++i) {
    if (i > 0) step.prepare(first + i);
    const glm::dvec3 gaze = gaze_of(step.sample());
    const glm::dvec3 world = step.sample().head.world_from_head.orientation * gaze;
    if (!is_recorded(step.sample())) return std::numeric_limits<double>::infinity();
    if (i > 0) most = std::max({most, degrees_between(gaze, last_gaze), degrees_between(world, last_world)});
    last_gaze = gaze, last_world = world;
  }
  return most;
}

std::vector<Moment> look_at(FrameStep& step, const FrameRange& range, std::int64_t clip,
                            const SeenContrast& contrast) {
  const std::int64_t room = range.count - clip + 1;  // first frames of a clip
  const std::int64_t moments = std::min(kMostMoments, std::max<std::int64_t>(1, room / clip));
  std::vector<Moment> all;
  for (std::int64_t i = 0; i < moments; ++i) {
    const std::int64_t number = range.first + (2 * i + 1) * room / (2 * moments);
    step.prepare(number);
    Moment moment;
    moment.frame = describe(step, range, number);
    if (contrast) moment.contrast = contrast(step);
    moment.unrest_deg = unrest_deg(step, number, clip);
    all.push_back(moment);
  }
  return all;
}

// At least as many as frames are wanted.
void keep_what_shows_more(std::vector<Moment>& moments, std::size_t count) {
  std::stable_sort(moments.begin(), moments.end(),
                   [](const Moment& a, const Moment& b) { return a.contrast > b.contrast; });
  moments.resize(std::max(std::min(count, moments.size()), (moments.size() + 1) / 2));
}

}  // namespace

StudyFrames choose_frames(FrameStep& step, const FrameRange& range, int count, const SeenContrast& contrast) {
  const std::int64_t clip = std::min<std::int64_t>(kClipFrames, range.count);
  step.rewind();
  std::vector<Moment> moments = look_at(step, range, clip, contrast);
  if (contrast) keep_what_shows_more(moments, static_cast<std::size_t>(count));
  StudyFrames chosen;
  const auto by_unrest = [](const Moment& a, const Moment& b) { return a.unrest_deg < b.unrest_deg; };
  const std::int64_t clip_first = std::min_element(moments.begin(), moments.end(), by_unrest)->frame.number;

  std::stable_sort(moments.begin(), moments.end(), [](const Moment& a, const Moment& b) {
    return a.frame.head_deg_per_s < b.frame.head_deg_per_s;
  });
  const std::size_t parts = std::min(static_cast<std::size_t>(count), moments.size());
  for (std::size_t part = 0; part < parts; ++part) {
    const auto begin = moments.begin() + static_cast<std::ptrdiff_t>(part * moments.size() / parts);
    const auto end = moments.begin() + static_cast<std::ptrdiff_t>((part + 1) * moments.size() / parts);
    std::stable_sort(begin, end,
                     [](const Moment& a, const Moment& b) { return a.frame.gaze_deg < b.frame.gaze_deg; });
    // Parts 0, 1, 2 take the ranks of parts 1, 2, 0: the middle, the far and the near.
    const std::size_t rank = (part + parts / 2) % parts;
    const auto size = static_cast<std::size_t>(end - begin);
    chosen.frames.push_back(
        (begin + static_cast<std::ptrdiff_t>((2 * rank + 1) * size / (2 * parts)))->frame);
  }
  std::sort(chosen.frames.begin(), chosen.frames.end(),
            [](const StudyFrame& a, const StudyFrame& b) { return a.number < b.number; });

  step.rewind();
  for (std::int64_t i = 0; i < clip; ++i) {
    step.prepare(clip_first + i);
    chosen.clip.push_back(describe(step, range, clip_first + i));
  }
  step.rewind();
  return chosen;
}

}  // namespace herr
