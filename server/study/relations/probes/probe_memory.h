// What probes remember, step by step, on chosen materials and times. Before: a relation's case. After:
// probes_relations.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "server/study/relations/relation_case.h"

namespace herr {

// Irradiance that all probes tell, W/m^2: of each set and probe three channels of each direction.
using ProbeLight = std::vector<float>;

// NaN where there is one.
double brightest(const ProbeLight& light);
// "probe 12 of everything, direction 5"
std::string probe_place(std::size_t index, int probes);

// The case with all light, few probes that are all updated in every frame, and no reaction to large changes.
RelationCase probe_case(RelationCase subject);
// Radiance 1 all around: every surface emits what it does not reflect, and so does what is beyond.
RelationCase furnace_case(RelationCase subject, float albedo);
// Nothing in it shines any more.
RelationCase without_light(RelationCase subject);
// Of anything that a ray meets which leaves the scene: the largest irradiance.
double brightest_surroundings(const Scene& scene);

// A renderer whose frames only update probes.
class ProbeMemory {
 public:
  explicit ProbeMemory(RelationCase subject);
  ProbeMemory(const ProbeMemory&) = delete;
  ProbeMemory& operator=(const ProbeMemory&) = delete;

  // Display periods after the case's own time, rounded to ns.
  TimeNs at(int frame) const;
  // Probes take up a frame at a time. An earlier one than the last is another run: all is forgotten first.
  void step(TimeNs t_ns, bool lights_on = true);
  ProbeLight light() const;
  std::vector<LinearPicture> picture(TimeNs t_ns);

  int probes() const;
  Renderer& renderer() { return renderer_; }
  const RelationCase& subject() const { return subject_; }

 private:
  const RelationCase subject_;
  SceneState dark_;
  Renderer renderer_;
};

}  // namespace herr
