// A world as it was when its scene was loaded, for a session that begins again.
#include "scenes/changes/world.h"

namespace herr {
namespace {

// But for where they stand.
bool looks_the_same(const Instance& a, const Instance& b) {
  return a.present == b.present && a.kind == b.kind && a.mesh == b.mesh && a.grid == b.grid &&
         a.material == b.material && a.catcher == b.catcher;
}

}  // namespace

void World::restart() {
  scene_.lights = lights_at_start_;
  if (relit_) note_relit();
  relit_ = false;
  restart_instances();
  restart_live();
  timeline_next_ = 0;
  advance(0);
}

// Slots that came later stay, empty.
void World::restart_instances() {
  state_.changes.resize(scene_.instances.size());
  own_material_.resize(scene_.instances.size(), kNone);
  for (std::uint32_t slot = 0; slot < scene_.instances.size(); ++slot) {
    Instance& instance = scene_.instances[slot];
    if (slot >= instances_at_start_.size()) {
      if (instance.present) note_renewed(slot);
      instance.present = false;
      continue;
    }
    const Instance& at_start = instances_at_start_[slot];
    if (!looks_the_same(instance, at_start)) {
      note_renewed(slot);
    } else if (instance.world_from_object != at_start.world_from_object) {
      note_moved(slot);
    }
    instance = at_start;
  }
}

void World::restart_live() {
  live_.clear();
  live_names_.clear();
  free_live_.clear();
  free_slots_.clear();
  for (std::size_t i = scene_.instances.size(); i-- > instances_at_start_.size();)
    free_slots_.push_back(static_cast<std::uint32_t>(i));
  for (std::size_t i = scene_.objects.size(); i-- > 0;) {
    const PlacedObject& object = scene_.objects[i];
    if (object.present) continue;
    for (std::uint32_t part = object.count; part-- > 0;) free_slots_.push_back(object.first + part);
  }
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    const PlacedObject& object = scene_.objects[i];
    if (!object.present) continue;
    Live& live = live_.emplace_back();
    live = {object.name,
            static_cast<std::uint32_t>(i),
            object.start(),
            {},
            true,
            animates(static_cast<std::uint32_t>(i)),
            object.path.empty() ? nullptr : &object.path};
    for (std::uint32_t part = 0; part < object.count; ++part) live.slots.push_back(object.first + part);
    if (object.name.empty()) continue;
    const auto [entry, added] =
        live_names_.try_emplace(object.name, static_cast<std::uint32_t>(live_.size() - 1));
    if (!added) entry->second = kAmbiguous;
  }
}

}  // namespace herr
