// What the eyes look at, one thing after another: points of the room that stand still or move evenly, each
// for a while. Before: the seed and the head. After: gaze_motion turns the eyes from one to the next.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "server/synth/head_motion.h"
#include "server/synth/seeded_random.h"

namespace herr {

enum class GazeKind {
  fixations,  // looks about: fixations on points 1-5 m away
  pursuit,    // follows targets that move at 5-30 degrees a second, with catch-up saccades
  reading,    // reads page after page, 0.6 m away
  still,      // straight ahead in the head, whatever the head does
  jumping,    // another direction with each row: no eye does that; a stress test for foveation
};
const std::vector<std::string>& gaze_names();  // in the order of GazeKind

// 21 ms and 2.2 ms for each degree: the main sequence (R. H. S. Carpenter, Movements of the eyes, 1988).
double saccade_duration_s(double amplitude_deg);

// The eye arrives at start_s and leaves at leave_s.
struct GazeTarget {
  double start_s = 0, leave_s = 0;
  glm::dvec3 point{0.0};     // world, at start_s
  glm::dvec3 velocity{0.0};  // metres per second, of the eye's aim

  glm::dvec3 at(double time_s) const { return point + (time_s - start_s) * velocity; }
};

// Not thread-safe. `head` must outlive it.
class GazeTargets {
 public:
  // `kind`: fixations, pursuit or reading.
  GazeTargets(std::uint64_t seed, GazeKind kind, const HeadMotion& head);
  GazeTarget first();
  // Begins when the saccade from `now` lands.
  GazeTarget next(const GazeTarget& now);

 private:
  // A target that flies past.
  struct Pursued {
    double appears_s = 0, ends_s = 0;
    glm::dvec3 point{0.0}, velocity{0.0};  // at appears_s
  };
  // Lines of text, x to the right and y up from the page's middle.
  struct Page {
    Pose world_from_page;
    double column_m = 0;
    int line = 0;
  };
  glm::dvec3 point_ahead(double time_s);
  GazeTarget fixation(double time_s);
  GazeTarget pursuit(double time_s);
  GazeTarget word(double time_s);
  void chase_another(double time_s);
  void turn_page(double time_s);
  glm::dvec3 place_on_page() const;
  bool within_reach(const glm::dvec3& point, double time_s) const;
  double stay_s(const GazeTarget& target);
  double leave_s(const GazeTarget& target, double stay_s) const;

  SeededRandom random_;
  GazeKind kind_;
  const HeadMotion* head_;
  Pursued pursued_;
  Page page_;
};

// Between two directions of any length.
double angle_between_deg(const glm::dvec3& a, const glm::dvec3& b);

}  // namespace herr
