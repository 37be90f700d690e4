#include "server/study/relations/gaze/gaze_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <stdexcept>
#include <variant>

#include "renderer/foveation/polar_map.h"
#include "renderer/settings_list.h"
#include "server/output/srgb_table.h"
#include "server/study/report/figure_text.h"

namespace herr {
namespace {

const Viewport* first_viewport(const DisplayProfile& profile, Eye eye) {
  const auto found = std::find_if(profile.viewports.begin(), profile.viewports.end(),
                                  [eye](const Viewport& viewport) { return viewport.eye == eye; });
  return found != profile.viewports.end() ? &*found : nullptr;
}

// The centre of the pixel nearest to the viewport's middle: there the pole is a pixel's own.
glm::dvec3 middle_of(const Viewport& v) {
  const auto along = [](double from, double to, int pixels) {
    return from + (to - from) * (pixels / 2 + 0.5) / pixels;
  };
  return {along(v.tan_left, v.tan_right, v.width_px), along(v.tan_up, v.tan_down, v.height_px), -1};
}

// `direction_of(viewport)` in each eye's space; straight ahead for an eye without viewport.
template <typename DirectionOf>
SampledGaze gaze_along(const RelationCase& subject, const DirectionOf& direction_of) {
  SampledGaze gaze = gaze_ahead(subject.sample);
  for (const Eye eye : kEyes) {
    const auto e = static_cast<std::size_t>(eye);
    const Viewport* viewport = first_viewport(subject.profile, eye);
    if (viewport == nullptr) continue;
    gaze.head_direction[e] =
        subject.sample.head_from_eye[e].orientation * glm::normalize(direction_of(*viewport));
    gaze.source[e] = SampleSource::exact;
  }
  return gaze;
}

void whiten(VoxelGrid& grid) {
  for (VoxelGrid::Brick& brick : grid.bricks) {
    for (std::uint32_t& rgba : brick) rgba = rgba >> 24 != 0 ? 0xffffffffu : 0u;
  }
}

// The pixel whose `distance(texel)` is largest.
template <typename Distance>
PictureDistance farthest_texel(const RenderedFrame& frame, const DisplayProfile& profile,
                               const Distance& distance) {
  PictureDistance worst;
  for (std::size_t v = 0; v < frame.viewports.size(); ++v) {
    const ViewportImage& image = frame.viewports[v];
    for (int y = 0; y < image.height_px; ++y) {
      const std::uint16_t* texel = image.row(y);
      for (int x = 0; x < image.width_px; ++x, texel += 4) {
        std::array<double, 4> rgba{};
        for (std::size_t c = 0; c < 4; ++c) rgba[c] = double{float_from_half(texel[c])};
        double apart = distance(rgba);
        if (std::isnan(apart)) apart = std::numeric_limits<double>::infinity();
        if (apart <= worst.error) continue;
        worst = {apart,
                 profile.viewports[v].name + ", pixel (" + std::to_string(x) + ", " + std::to_string(y) +
                     "): (" + figure(rgba[0], 4) + ", " + figure(rgba[1], 4) + ", " + figure(rgba[2], 4) +
                     "), coverage " + figure(rgba[3], 4),
                 v};
      }
    }
  }
  return worst;
}

// From the gaze to the viewport's farthest corner.
double reach_deg(const FrameSample& sample, const Viewport& v) {
  const auto e = static_cast<std::size_t>(v.eye);
  const glm::dvec3 gaze = sample.gaze.head_direction[e];
  double reach = 0;
  for (const double x : {v.tan_left, v.tan_right}) {
    for (const double y : {v.tan_down, v.tan_up}) {
      const glm::dvec3 corner = sample.head_from_eye[e].orientation * glm::dvec3(x, y, -1);
      reach = std::max(reach, std::atan2(glm::length(glm::cross(gaze, corner)), glm::dot(gaze, corner)));
    }
  }
  return glm::degrees(reach);
}

int even_up_to(double wanted, int most) {
  return std::clamp(static_cast<int>(std::min(wanted, 1e9)) / 2 * 2 + 2, 2, most / 2 * 2);
}

}  // namespace

SampledGaze gaze_ahead(const FrameSample& sample) {
  SampledGaze gaze;
  gaze.stamp_ns = sample.t_ns;
  for (std::size_t e = 0; e < gaze.head_direction.size(); ++e)
    gaze.head_direction[e] = sample.head_from_eye[e].orientation * glm::dvec3(0, 0, -1);
  return gaze;
}

std::vector<NamedGaze> gazes_at_limits(const RelationCase& subject) {
  const double off = glm::radians(80.0);
  SampledGaze lost;  // as a session has it: straight ahead of the head
  lost.stamp_ns = subject.sample.t_ns;
  return {
      {"at the middle of a viewport", gaze_along(subject, middle_of)},
      {"at a corner of a viewport",
       gaze_along(subject, [](const Viewport& v) { return glm::dvec3(v.tan_right, v.tan_up, -1); })},
      {"80 degrees off",
       gaze_along(subject, [off](const Viewport&) { return glm::dvec3(std::sin(off), 0, -std::cos(off)); })},
      {"behind the head", gaze_along(subject, [](const Viewport&) { return glm::dvec3(0, 0, 1); })},
      {"lost", lost}};
}

std::vector<SampledGaze> gazes_around(const FrameSample& sample, double within_deg) {
  constexpr int kGazes = 16;
  const double golden_angle = glm::pi<double>() * (3 - std::sqrt(5.0));
  std::vector<SampledGaze> gazes(kGazes, sample.gaze);
  for (int i = 0; i < kGazes; ++i) {
    const double off = glm::radians(within_deg) * std::sqrt((i + 0.5) / kGazes), about = golden_angle * i;
    const glm::dquat turn = glm::angleAxis(off, glm::dvec3(std::cos(about), std::sin(about), 0));
    for (glm::dvec3& direction : gazes[static_cast<std::size_t>(i)].head_direction)
      direction = turn * direction;
  }
  return gazes;
}

std::vector<SampledGaze> gazes_of_no_direction() {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(),
                   kInfinity = std::numeric_limits<double>::infinity();
  std::vector<SampledGaze> gazes;
  for (const glm::dvec3& direction : {glm::dvec3(kNaN, 0, -1), {kInfinity, 0, 0}, {0, 0, 0}}) {
    gazes.emplace_back();
    gazes.back().head_direction = {direction, direction};
  }
  return gazes;
}

DisplayProfile single_viewport(double degrees, int pixels) {
  Viewport viewport;
  viewport.name = "only";
  viewport.width_px = viewport.height_px = pixels;
  viewport.tan_right = viewport.tan_up = std::tan(glm::radians(degrees / 2));
  viewport.tan_left = viewport.tan_down = -viewport.tan_right;
  DisplayProfile profile;
  profile.name = "single";
  profile.viewports = {viewport};
  return profile;
}

RelationCase own_surfaces(RelationCase subject) {
  subject = hard_light(std::move(subject));
  subject.settings.detail_error = 0;
  return subject;
}

RelationCase white_case(RelationCase subject) {
  subject = hard_light(std::move(subject));
  Scene& scene = subject.scene;
  Material white;
  white.name = "white";
  white.base_colour = glm::vec3(1.0f);
  white.unlit = true;
  scene.materials = {white};
  for (Instance& instance : scene.instances) instance.material = 0;
  for (TriangleMesh& mesh : scene.meshes) mesh.colours.clear();
  for (VoxelGrid& grid : scene.voxel_grids) whiten(grid);
  scene.textures.clear();
  scene.lights.clear();
  subject.state.lights.clear();
  scene.ambient = glm::vec3(0.0f);
  scene.environment = glm::vec3(1.0f);
  scene.environment_map = {};
  subject.settings.camera = true;  // and no feed: the environment lies behind
  subject.settings.gaze_marker = subject.settings.debug_tiles = false;
  return subject;
}

RelationCase white_over_nothing(RelationCase subject) {
  subject = white_case(std::move(subject));
  subject.settings.camera = false;
  // Bicubic weights are negative in part, and what they make of an edge is limited by channel.
  if (subject.settings.filter == ResampleFilter::bicubic) subject.settings.filter = ResampleFilter::bilinear;
  return subject;
}

PictureDistance farthest_from_white(const RenderedFrame& frame, const DisplayProfile& profile) {
  return farthest_texel(frame, profile, [](const std::array<double, 4>& rgba) {
    double apart = 0;
    // A sum keeps a value that is no number, the largest of some need not.
    for (const double value : rgba) apart = std::isnan(value) ? value : std::max(apart, std::abs(value - 1));
    return apart;
  });
}

PictureDistance farthest_from_coverage(const RenderedFrame& frame, const DisplayProfile& profile) {
  return farthest_texel(frame, profile, [](const std::array<double, 4>& rgba) {
    double apart = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double off = std::abs(rgba[c] - rgba[3]);
      apart = std::isnan(off) ? off : std::max(apart, off);
    }
    return apart;
  });
}

PolarSize largest_polar_size() {
  RenderSettings settings;
  for (const Setting& setting : settings_of(settings)) {
    if (const auto* size = std::get_if<SizeSetting>(&setting.value))
      return {size->widest_per_eye, size->highest};
  }
  throw std::logic_error("no setting is a polar size");
}

PolarSize finer_than_pixels(const RelationCase& subject) {
  double width = 1, height = 1;
  for (const Eye eye : kEyes) {
    double farthest = 1e-3;
    for (const Viewport& v : subject.profile.viewports) {
      if (v.eye == eye) farthest = std::max(farthest, reach_deg(subject.sample, v));
    }
    const PolarMap map = PolarMap::up_to(farthest);
    for (const Viewport& v : subject.profile.viewports) {
      if (v.eye != eye) continue;
      const double density = finest_pixels_per_degree(v), reach = reach_deg(subject.sample, v);
      width = std::max(width, density * map.log_range * (1 + reach));
      height = std::max(height, density * 360 * (reach < 90 ? std::sin(glm::radians(reach)) : 1.0));
    }
  }
  const PolarSize most = largest_polar_size();
  return {even_up_to(width, most.width), even_up_to(height, most.height)};
}

PolarSize finer_than_pixels_ahead(double degrees, int pixels, double within_deg) {
  const Viewport v = single_viewport(degrees, pixels).viewports.front();
  const double corner = std::hypot(v.tan_right, v.tan_up), pixel = (v.tan_right - v.tan_left) / pixels;
  const double reach = glm::degrees(std::atan(corner)) + within_deg;
  const double density = finest_pixels_per_degree(v);
  // Across the radius a pixel at the corner is `pixel` wide, so far away; and by `within` the radius of the
  // buffer turns away from that of the viewport.
  const double around =
      glm::radians(std::hypot(1.0, corner) / pixel) + density * std::sin(glm::radians(within_deg));
  const PolarSize most = largest_polar_size();
  return {even_up_to(density * PolarMap::up_to(reach).log_range * (1 + reach), most.width),
          even_up_to(360 * around, most.height)};
}

}  // namespace herr
