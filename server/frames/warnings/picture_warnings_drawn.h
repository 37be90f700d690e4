// What the drawn pictures of a run turn out to lack: objects in view, or light. Before: each frame's pictures
// and head. After: the warnings of replay.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/viewport_image.h"
#include "scenes/model/scene.h"
#include "sessions/format/display_profile.h"
#include "sessions/format/pose.h"

namespace herr {

// Not thread-safe.
class DrawnPictures {
 public:
  // `world_from_head` in the scene. Looks at pixels only until some channel reaches kDark.
  void add(const std::vector<ViewportImage>& pictures, const Pose& world_from_head);

  // After `frames` frames, of which `object_samples` samples met a virtual object: nothing_seen_warning(),
  // or, where every picture of all frames is darker than kDark as shown, how dark, and what brightens them.
  // Of frames that were not added nobody knows how dark they are. Empty: nothing to say.
  std::string warning(const Scene& scene, std::int64_t frames, std::int64_t object_samples,
                      const DisplayProfile& profile) const;

  static constexpr double kDark = 1.0 / 255;  // white is 1

 private:
  std::string dark_warning(const Scene& scene) const;

  std::int64_t frames_ = 0;
  std::optional<Pose> first_head_;
  double brightest_ = 0;  // channel, as shown; up to the first picture that reaches kDark
  double exposure_ = 1;
};

}  // namespace herr
