#include "scenes/placed_objects.h"

#include <vector>

namespace herr {

void complete_objects(Scene& scene) {
  std::vector<bool> belongs(scene.instances.size());
  for (const PlacedObject& object : scene.objects) {
    for (std::uint32_t part = 0; part < object.count; ++part) belongs[object.first + part] = true;
  }
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (belongs[i]) continue;
    Instance& instance = scene.instances[i];
    PlacedObject object{instance.name, {}, static_cast<std::uint32_t>(i), 1, instance.present};
    object.placement.translation = instance.world_from_object[3];
    instance.placed_from_object = instance.world_from_object;
    instance.placed_from_object[3] = glm::dvec3(0.0);
    scene.objects.push_back(std::move(object));
  }
}

}  // namespace herr
