#include "scenes/changes/world.h"

#include <algorithm>
#include <utility>

#include "scenes/gltf/file/gltf_limits.h"
#include "scenes/model/transform_checks.h"
#include "sessions/files/input_error.h"
#include "sessions/files/nearest_name.h"

namespace herr {
namespace {

template <typename Things>
std::unordered_map<std::string, std::uint32_t> names_of(const Things& things) {
  std::unordered_map<std::string, std::uint32_t> names;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const auto [entry, added] = names.try_emplace(things[i].name, static_cast<std::uint32_t>(i));
    if (!added) entry->second = kAmbiguous;
  }
  names.erase("");
  return names;
}

// A name as text and where it may have come from.
ChangeProblem unknown(const char* kind, const std::string& name,
                      const std::unordered_map<std::string, std::uint32_t>& known) {
  std::vector<std::string> names;
  for (const auto& [other, index] : known) names.push_back(other);
  ChangeProblem problem{std::string("names ") + kind + " \"" + printable(name) + "\", which is not there",
                        "name one that is"};
  if (const std::string nearest = nearest_name(name, names); !nearest.empty())
    problem.remedy += "; the nearest is \"" + printable(nearest) + "\"";
  return problem;
}

}  // namespace

World::World(Scene& scene)
    : scene_(scene),
      instances_at_start_(scene.instances),
      lights_at_start_(scene.lights),
      materials_at_start_(scene.materials.size()),
      has_paths_(std::any_of(scene.objects.begin(), scene.objects.end(),
                             [](const PlacedObject& object) { return !object.path.empty(); })),
      objects_(names_of(scene.objects)),
      lights_(names_of(scene.lights)) {
  state_.changes = SlotChanges(scene.revision);
  for (const AnimatedModel& model : scene.models) models_.emplace_back(model);
  state_.poses.resize(scene.deformations.size());
  restart();
}

void World::note_moved(std::uint32_t slot) {
  state_.changes.note_moved(slot);
  scene_.revision = state_.changes.latest();
}

void World::note_renewed(std::uint32_t slot) {
  state_.changes.note_renewed(slot);
  scene_.revision = state_.changes.latest();
}

void World::note_relit() {
  state_.changes.note_relit();
  scene_.revision = state_.changes.latest();
}

void World::advance(double time_s) {
  apply_timeline_until(time_s);
  move_on(time_s);
  scene_state_at(scene_, time_s, state_);
}

void World::apply_timeline_until(double time_s) {
  while (timeline_next_ < scene_.timeline.size() && scene_.timeline[timeline_next_].time_s <= time_s) {
    const std::size_t entry = timeline_next_++;
    if (const auto problem = change(scene_.timeline[entry])) {
      const std::filesystem::path file =
          scene_.files.empty() ? std::filesystem::path() : scene_.files.front();
      throw InputError(file, 0, "timeline[" + std::to_string(entry) + "] " + problem->what, problem->remedy);
    }
  }
}

std::optional<ChangeProblem> World::apply(const SceneChange& wanted) {
  apply_timeline_until(wanted.time_s);
  return change(wanted);
}

std::optional<ChangeProblem> World::change(const SceneChange& wanted) {
  switch (wanted.kind) {
    case ChangeKind::spawn:
      return spawn(wanted);
    case ChangeKind::remove:
      return remove(wanted);
    case ChangeKind::move:
      return move(wanted);
    case ChangeKind::set_light:
      return set_light(wanted);
    case ChangeKind::set_material:
      return set_material(wanted);
    case ChangeKind::replace_mesh:
      return replace_mesh(wanted);
  }
  return std::nullopt;
}

std::optional<ChangeProblem> World::find(const Names& names, const std::string& name, const char* kind,
                                         std::uint32_t& index) const {
  const auto entry = names.find(name);
  if (entry == names.end()) return unknown(kind, name, names);
  index = entry->second;
  if (index != kAmbiguous) return std::nullopt;
  return ChangeProblem{std::string("names ") + kind + " \"" + printable(name) + "\", which several have",
                       "give each a name of its own in the scene document"};
}

// Would a part of the object stand so that it cannot be traced?
std::optional<ChangeProblem> World::misplaced(std::uint32_t object, const Placement& placement) const {
  const PlacedObject& placed = scene_.objects[object];
  const glm::dmat4x3 world_from_placed = placement.matrix();
  for (std::uint32_t part = 0; part < placed.count; ++part) {
    const Instance& instance = instances_at_start_[placed.first + part];
    if (instance.model >= 0) continue;  // what its model does with it, its poses say
    if (const auto problem = transform_problem(compose(world_from_placed, instance.placed_from_object)))
      return ChangeProblem{"places \"" + printable(placed.name) + "\" so that it " + *problem,
                           "write a larger scale or a nearer place"};
  }
  return std::nullopt;
}

// Would it at any key of its path, or where it stands?
std::optional<ChangeProblem> World::misplaced(std::uint32_t object, const Live& live) const {
  if (live.path == nullptr) return misplaced(object, live.placement);
  for (const PathKey& key : live.path->keys) {
    if (auto problem = misplaced(object, key.placement)) return problem;
  }
  return std::nullopt;
}

bool World::animates(std::uint32_t object) const {
  const PlacedObject& placed = scene_.objects[object];
  const auto first = instances_at_start_.begin() + placed.first;
  return std::any_of(first, first + placed.count, [](const Instance& part) { return part.model >= 0; });
}

std::uint32_t World::free_slot() {
  if (!free_slots_.empty()) {
    const std::uint32_t slot = free_slots_.back();
    free_slots_.pop_back();
    return slot;
  }
  scene_.instances.emplace_back();
  state_.changes.resize(scene_.instances.size());
  own_material_.push_back(kNone);
  return static_cast<std::uint32_t>(scene_.instances.size() - 1);
}

// Fills slots with copies of the object's instances.
void World::show(std::uint32_t index, std::uint32_t object) {
  const PlacedObject& placed = scene_.objects[object];
  Live& live = live_[index];
  live.object = object;
  live.present = true;
  live.animated = animates(object);
  live.slots.clear();
  for (std::uint32_t part = 0; part < placed.count; ++part) {
    const std::uint32_t slot = free_slot();
    scene_.instances[slot] = instances_at_start_[placed.first + part];
    scene_.instances[slot].present = true;
    note_renewed(slot);
    live.slots.push_back(slot);
  }
  place(live);
}

void World::hide(Live& live) {
  // Backwards: who asks next gets them in the same order.
  for (std::size_t i = live.slots.size(); i-- > 0;) {
    scene_.instances[live.slots[i]].present = false;
    note_renewed(live.slots[i]);
    free_slots_.push_back(live.slots[i]);
  }
  live.slots.clear();
}

void World::place(Live& live) {
  const glm::dmat4x3 world_from_placed = live.placement.matrix();
  for (const std::uint32_t slot : live.slots) {
    Instance& instance = scene_.instances[slot];
    const glm::dmat4x3 world_from_object = compose(world_from_placed, placed_from_object(instance));
    // A model may shrink a part to nothing for a while: then it is not there. Keys of a path are checked;
    // what lies between two may be rounded across a limit.
    const bool may_vanish = instance.model >= 0 || live.path != nullptr;
    const bool present = !may_vanish || !transform_problem(world_from_object);
    if (present != instance.present) note_renewed(slot);
    instance.present = present;
    if (!present || world_from_object == instance.world_from_object) continue;
    instance.world_from_object = world_from_object;
    note_moved(slot);
  }
}

glm::dmat4x3 World::placed_from_object(const Instance& instance) const {
  if (instance.model < 0) return instance.placed_from_object;
  const ModelPose& model = models_[static_cast<std::size_t>(instance.model)];
  return compose(model.model_from_node(instance.node), instance.placed_from_object);
}

// What moves by itself: models along their clips, objects along their paths.
void World::move_on(double time_s) {
  if (models_.empty() && !has_paths_) return;
  for (ModelPose& model : models_) model.pose(time_s);
  for (Live& live : live_) {
    if (!live.present) continue;
    const Placement placement = live.path != nullptr ? live.path->at(time_s) : live.placement;
    const bool moved = placement != live.placement;
    live.placement = placement;
    if (moved || live.animated) place(live);
  }
  for (std::size_t i = 0; i < scene_.deformations.size(); ++i) {
    const MeshDeformation& deformation = scene_.deformations[i];
    models_[static_cast<std::size_t>(deformation.model)].bend(deformation, state_.poses[i]);
  }
}

std::optional<ChangeProblem> World::spawn(const SceneChange& wanted) {
  std::uint32_t object = 0;
  if (auto problem = find(objects_, wanted.of, "object", object)) return problem;
  if (live_names_.count(wanted.name) != 0) {
    return ChangeProblem{"spawns \"" + printable(wanted.name) + "\", which is there already",
                         "give the copy a name of its own, or remove the other first"};
  }
  const PlacedObject& placed = scene_.objects[object];
  if (static_cast<std::int64_t>(scene_.instances.size() + placed.count) > kMaxInstances) {
    return ChangeProblem{"makes more than a million instances", "remove some objects first"};
  }
  // A copy that is given a place stands there.
  const bool on_path = !placed.path.empty() && !wanted.placement.any();
  const Placement placement =
      on_path ? placed.path.at(wanted.time_s) : wanted.placement.apply(placed.placement);
  if (!on_path) {
    if (auto problem = misplaced(object, placement)) return problem;
  }
  std::uint32_t index = 0;
  if (free_live_.empty()) {
    index = static_cast<std::uint32_t>(live_.size());
    live_.emplace_back();
  } else {
    index = free_live_.back();
    free_live_.pop_back();
  }
  live_[index].name = wanted.name;
  live_[index].placement = placement;
  live_[index].path = on_path ? &placed.path : nullptr;
  live_names_.emplace(wanted.name, index);
  show(index, object);
  if (wanted.material) give_material(live_[index], *wanted.material);
  return std::nullopt;
}

std::optional<ChangeProblem> World::remove(const SceneChange& wanted) {
  std::uint32_t index = 0;
  if (auto problem = find(live_names_, wanted.name, "object", index)) return problem;
  hide(live_[index]);
  live_[index].present = false;
  live_names_.erase(wanted.name);
  free_live_.push_back(index);
  return std::nullopt;
}

std::optional<ChangeProblem> World::move(const SceneChange& wanted) {
  std::uint32_t index = 0;
  if (auto problem = find(live_names_, wanted.name, "object", index)) return problem;
  Live& live = live_[index];
  // From where its path has it at that time, not at the frame before.
  const Placement placement =
      wanted.placement.apply(live.path != nullptr ? live.path->at(wanted.time_s) : live.placement);
  if (auto problem = misplaced(live.object, placement)) return problem;
  live.placement = placement;
  live.path = nullptr;
  place(live);
  return std::nullopt;
}

std::optional<ChangeProblem> World::replace_mesh(const SceneChange& wanted) {
  std::uint32_t index = 0, object = 0;
  if (auto problem = find(live_names_, wanted.name, "object", index)) return problem;
  if (auto problem = find(objects_, wanted.of, "object", object)) return problem;
  if (auto problem = misplaced(object, live_[index])) return problem;
  hide(live_[index]);
  show(index, object);
  return std::nullopt;
}

void World::give_material(Live& live, const MaterialOverride& material) {
  for (const std::uint32_t slot : live.slots) {
    Instance& instance = scene_.instances[slot];
    Material changed = material.apply(scene_.materials[instance.material]);
    std::uint32_t& own = own_material_[slot];
    if (own == kNone) {
      own = static_cast<std::uint32_t>(scene_.materials.size());
      scene_.materials.push_back(std::move(changed));
    } else {
      scene_.materials[own] = std::move(changed);
    }
    instance.material = own;
    note_renewed(slot);
  }
}

std::optional<ChangeProblem> World::set_material(const SceneChange& wanted) {
  std::uint32_t index = 0;
  if (auto problem = find(live_names_, wanted.name, "object", index)) return problem;
  give_material(live_[index], *wanted.material);
  return std::nullopt;
}

std::optional<ChangeProblem> World::set_light(const SceneChange& wanted) {
  std::uint32_t index = 0;
  if (auto problem = find(lights_, wanted.name, "light", index)) return problem;
  AreaLight& light = scene_.lights[index];
  const LightChange& to = wanted.light;
  const bool placeless = light.kind == LightKind::sun && to.centre;
  if (placeless || (light.kind != LightKind::box && to.size) ||
      (light.kind == LightKind::box && to.direction)) {
    return ChangeProblem{"sets what light \"" + printable(wanted.name) + "\" does not have",
                         "a box has centre and size, a spot centre and direction, a sun a direction"};
  }
  note_relit();
  relit_ = true;
  if (to.intensity_w_sr) light.intensity_w_sr = *to.intensity_w_sr;
  if (to.centre) light.centre = *to.centre;
  if (to.size) light.size = *to.size;
  if (to.direction) light.direction = *to.direction;
  if (to.is_virtual) light.is_virtual = *to.is_virtual;
  return std::nullopt;
}

}  // namespace herr
