// The form of each mesh that is shown, from frame to frame. Before: a scene whose meshes have coarser forms,
// this frame's eyes. After: embree_scene shows the chosen ones.
// Not thread-safe. A frame allocates nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x3.hpp>
#include <span>
#include <vector>

#include "renderer/detail/detail_choice.h"
#include "scenes/model/scene.h"

namespace herr {

class DetailLevels {
 public:
  // Measures every instance that has a choice. `scene` must outlive it.
  explicit DetailLevels(const Scene& scene);

  // Chooses for a frame: world_from(instance) is where each stands in it, and show(instance, mesh) is called
  // for each whose mesh changes. `most_samples`: that a form may lie off.
  template <typename WorldFrom, typename Show>
  void choose(std::span<const DetailEye> eyes, double most_samples, const WorldFrom& world_from,
              const Show& show) {
    for (Item& item : items_) {
      const DetailBall ball = placed(item.ball, world_from(item.instance));
      const int level = detail_level(item.errors_m, eyes, ball, item.level, most_samples);
      if (level == item.level) continue;
      item.level = level;
      show(item.instance, mesh_of(item));
    }
  }

  // After instances have come, gone or changed their mesh: all that have a choice now, at their full meshes;
  // show(instance, mesh) is called for those that had a coarser one. This forgets what was chosen.
  template <typename Show>
  void measure_anew(const Show& show) {
    for (const Item& item : items_) {
      const Instance& instance = scene_.instances[item.instance];
      if (item.level != 0 && instance.present && instance.kind == ShapeKind::mesh)
        show(item.instance, instance.mesh);
    }
    if (!items_.empty()) measure();
  }

  // One byte for each instance that has a choice; restored ones are shown by show(instance, mesh). Throws
  // std::invalid_argument for the levels of another scene.
  std::vector<std::byte> save() const;
  template <typename Show>
  void restore(std::span<const std::byte> levels, const Show& show) {
    set_levels(levels);
    for (const Item& item : items_) show(item.instance, mesh_of(item));
  }

 private:
  struct Item {
    std::size_t instance = 0;
    DetailBall ball;  // in object space
    std::vector<float> errors_m;
    int level = 0;  // until a frame is drawn the full mesh stands there
  };
  void measure();
  static DetailBall placed(const DetailBall& ball, const glm::dmat4x3& world_from_object);
  std::uint32_t mesh_of(const Item& item) const;
  void set_levels(std::span<const std::byte> levels);

  const Scene& scene_;
  std::vector<Item> items_;
};

// Instances that have a choice.
std::size_t detailed_instances(const Scene& scene);

}  // namespace herr
