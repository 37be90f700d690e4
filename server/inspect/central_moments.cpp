#include "server/inspect/central_moments.h"

#include <cmath>

namespace herr {

void find_central_moments(const std::vector<Pose>& poses, const std::vector<TimeNs>& stamps_ns,
                          TimeNs start_ns, std::vector<SceneObject>& objects) {
  for (SceneObject& object : objects) {
    if (!object.most_central) continue;
    for (std::size_t i = 0; i < poses.size() && !object.most_central_s; ++i) {
      const bool is_it = stamps_ns[i] >= start_ns && poses[i].position == object.most_central->position &&
                         poses[i].orientation == object.most_central->orientation;
      if (is_it) object.most_central_s = std::floor(static_cast<double>(stamps_ns[i] - start_ns) * 1e-8) / 10;
    }
  }
}

}  // namespace herr
