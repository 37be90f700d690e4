#include "server/study/relations/probes/probe_memory.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/scalar_constants.hpp>
#include <limits>
#include <utility>

#include "renderer/probes/probe_reader.h"
#include "server/study/relations/one_albedo.h"

namespace herr {
namespace {

constexpr double kFewProbes = 512;

void put_out(std::vector<AreaLight>& lights) {
  for (AreaLight& light : lights) light.intensity_w_sr = glm::vec3{0.0f};
}

}  // namespace

double brightest(const ProbeLight& light) {
  float most = 0;
  for (const float value : light) {
    if (!std::isfinite(value)) return std::numeric_limits<double>::quiet_NaN();
    most = std::max(most, value);
  }
  return double{most};
}

std::string probe_place(std::size_t index, int probes) {
  const std::size_t of_probe = 3 * LightNodes::kCount, probe = index / of_probe;
  const auto of_set = static_cast<std::size_t>(probes);
  return "probe " + std::to_string(probe % of_set) +
         (probe < of_set ? " of everything" : " of catchers alone") + ", direction " +
         std::to_string(index % of_probe / 3);
}

RelationCase probe_case(RelationCase subject) {
  subject = all_light(std::move(subject));
  ProbeSettings& probes = subject.settings.probes;
  probes.budget = 0;
  probes.react = false;
  const auto& counts = subject.scene.probes.counts;
  const double asked = double(counts[0]) * counts[1] * counts[2];
  probes.density = std::min(probes.density, std::cbrt(kFewProbes / asked));
  return subject;
}

RelationCase without_light(RelationCase subject) {
  subject = of_albedo(std::move(subject), 0);
  subject.scene.ambient = subject.scene.environment = glm::vec3{0.0f};
  subject.scene.environment_map = {};
  put_out(subject.scene.lights);
  put_out(subject.state.lights);
  return subject;
}

RelationCase furnace_case(RelationCase subject, float albedo) {
  subject = of_albedo(without_light(std::move(subject)), albedo);
  for (Material& material : subject.scene.materials) material.emission = glm::vec3{1 - albedo};
  subject.scene.ambient = subject.scene.environment = glm::vec3{1.0f};
  return subject;
}

double brightest_surroundings(const Scene& scene) {
  const glm::vec3& plain = scene.environment;
  float most = std::max({plain.x, plain.y, plain.z});
  const std::vector<float>& rgba = scene.environment_map.rgba;
  for (std::size_t i = 0; i < rgba.size(); ++i) {
    if (i % 4 != 3) most = std::max(most, rgba[i]);
  }
  return glm::pi<double>() * double{most};
}

ProbeMemory::ProbeMemory(RelationCase subject)
    : subject_(std::move(subject)),
      dark_(subject_.state),
      renderer_(subject_.scene, subject_.profile, subject_.settings, subject_.camera) {
  put_out(dark_.lights);
}

int ProbeMemory::probes() const {
  return renderer_.probes()->grid().size();
}

TimeNs ProbeMemory::at(int frame) const {
  return subject_.sample.t_ns + static_cast<TimeNs>(std::llround(frame * 1e9 / subject_.profile.display_hz));
}

void ProbeMemory::step(TimeNs t_ns, bool lights_on) {
  FrameSample sample = subject_.sample;
  sample.t_ns = t_ns;
  renderer_.skip_frame(sample, lights_on ? subject_.state : dark_);
}

ProbeLight ProbeMemory::light() const {
  const ProbeReader reader = *renderer_.probes();
  ProbeLight out;
  out.reserve(static_cast<std::size_t>(reader.sets() * reader.grid().size()) * 3 * LightNodes::kCount);
  ProbeReader::Light light;
  for (int set = 0; set < reader.sets(); ++set) {
    for (int probe = 0; probe < reader.grid().size(); ++probe) {
      reader.irradiance(set, probe, light);
      for (const glm::vec3& node : light) out.insert(out.end(), {node.x, node.y, node.z});
    }
  }
  return out;
}

std::vector<LinearPicture> ProbeMemory::picture(TimeNs t_ns) {
  RelationCase then;  // all that is asked of it
  then.state = subject_.state, then.sample = subject_.sample;
  then.sample.t_ns = t_ns;
  return next_picture(renderer_, then);
}

}  // namespace herr
