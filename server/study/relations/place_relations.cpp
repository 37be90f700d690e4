// Where a scene stands changes nothing: moved far away it gives the same picture.
#include <glm/geometric.hpp>

#include "server/study/relations/picture_distance.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

RelationCase moved_by(RelationCase subject, const glm::dvec3& way) {
  for (Instance& instance : subject.scene.instances) instance.world_from_object[3] += way;
  for (AreaLight& light : subject.state.lights) light.centre += way;
  for (AreaLight& light : subject.scene.lights) light.centre += way;
  if (subject.scene.probes.box) {
    subject.scene.probes.box->lower += way;
    subject.scene.probes.box->upper += way;
  }
  subject.scene.world_from_session.position += way;
  return subject;
}

void measure_moved(const RelationCase& subject, const std::vector<LinearPicture>& here, double metres,
                   RelationLog& log) {
  Relation relation;
  relation.name = "moved by " + shortest_text(metres) + " m";
  relation.holds = "scene and head moved as one give the same picture";
  relation.bound = 1e-3;
  relation.unit = "share of pixels beyond one 8-bit step";
  relation.bound_from =
      "places are rounded to 1.5e-8 m at 1e8 m: only rays that pass an edge as closely as that can change";
  const glm::dvec3 way = metres * glm::normalize(glm::dvec3(3, 1, -2));
  const std::vector<LinearPicture> there = picture_of(moved_by(subject, way));
  const PictureDistance apart = share_beyond_one_step(there, here, subject.profile);
  log.measured(relation, apart.error, apart.where,
               worst_pictures(apart, there, here, "moved | as it stands | difference"));
}

}  // namespace

void measure_place(const RelationCase& subject, RelationLog& log) {
  const RelationCase lit = all_light(subject);
  const std::vector<LinearPicture> here = picture_of(lit);
  for (const double metres : {1e3, 1e6, 1e8}) measure_moved(lit, here, metres, log);
}

}  // namespace herr
