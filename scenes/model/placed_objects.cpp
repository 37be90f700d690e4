#include "scenes/model/placed_objects.h"

#include <utility>
#include <vector>

namespace herr {

PlacedObject& add_object_of(std::uint32_t index, Scene& scene) {
  Instance& instance = scene.instances[index];
  PlacedObject object{instance.name, {}, index, 1, instance.present};
  object.placement.translation = instance.world_from_object[3];
  instance.placed_from_object = instance.world_from_object;
  instance.placed_from_object[3] = glm::dvec3(0.0);
  return scene.objects.emplace_back(std::move(object));
}

void complete_objects(Scene& scene) {
  std::vector<bool> belongs(scene.instances.size());
  for (const PlacedObject& object : scene.objects) {
    for (std::uint32_t part = 0; part < object.count; ++part) belongs[object.first + part] = true;
  }
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (!belongs[i]) add_object_of(static_cast<std::uint32_t>(i), scene);
  }
}

}  // namespace herr
