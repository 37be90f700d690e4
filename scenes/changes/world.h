// A scene over time: applies changes and animation to it in place and says what they touched.
// Before: load_scene, the session's events. After: the renderer, which reads the slots of the
// Scene again that SceneState::changes names. A state depends on the changes up to its time alone,
// not on the frames between.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "scenes/animation/model_pose.h"
#include "scenes/model/scene.h"

namespace herr {

// Why a change cannot be made, and what to do about it.
struct ChangeProblem {
  std::string what, remedy;
};

// In place of an index, where several things have the name.
inline constexpr std::uint32_t kAmbiguous = ~0u;

// Not thread-safe. Memory grows with the most instances that were ever there at once, not with time.
class World {
 public:
  // The scene as it was loaded, at time 0. It must outlive the world, and nobody else may change it.
  explicit World(Scene& scene);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // Back to the scene as it was loaded.
  void restart();
  // Makes one change after those of the timeline that are due by then. Times never decrease. A change that
  // cannot be made leaves everything as it was. Throws InputError where the timeline has one.
  [[nodiscard]] std::optional<ChangeProblem> apply(const SceneChange& change);
  // Timeline, animation and paths up to a time. Throws InputError for an entry of the timeline that
  // cannot be applied (called again it goes on with the next).
  void advance(double time_s);
  const SceneState& state() const { return state_; }

 private:
  // An object that is there.
  struct Live {
    std::string name;
    std::uint32_t object = 0;          // of Scene::objects, which it is a copy of
    Placement placement;               // on a path: of the last time that it was looked at
    std::vector<std::uint32_t> slots;  // of Scene::instances
    bool present = false;
    bool animated = false;             // a model moves a part of it
    const ObjectPath* path = nullptr;  // of Scene::objects; none: it stands
  };
  using Names = std::unordered_map<std::string, std::uint32_t>;
  static constexpr std::uint32_t kNone = ~0u;

  void apply_timeline_until(double time_s);
  std::optional<ChangeProblem> change(const SceneChange& change);
  std::optional<ChangeProblem> spawn(const SceneChange& change);
  std::optional<ChangeProblem> remove(const SceneChange& change);
  std::optional<ChangeProblem> move(const SceneChange& change);
  std::optional<ChangeProblem> set_light(const SceneChange& change);
  std::optional<ChangeProblem> set_material(const SceneChange& change);
  std::optional<ChangeProblem> replace_mesh(const SceneChange& change);

  std::optional<ChangeProblem> find(const Names& names, const std::string& name, const char* kind,
                                    std::uint32_t& index) const;
  std::optional<ChangeProblem> misplaced(std::uint32_t object, const Placement& placement) const;
  std::optional<ChangeProblem> misplaced(std::uint32_t object, const Live& live) const;
  bool animates(std::uint32_t object) const;
  void show(std::uint32_t live, std::uint32_t object);
  void hide(Live& live);
  void place(Live& live);
  void note_moved(std::uint32_t slot);
  void note_renewed(std::uint32_t slot);
  void note_relit();
  void restart_instances();
  void restart_live();
  void give_material(Live& live, const MaterialOverride& material);
  glm::dmat4x3 placed_from_object(const Instance& instance) const;
  std::uint32_t free_slot();
  void move_on(double time_s);

  Scene& scene_;
  const std::vector<Instance> instances_at_start_;
  const std::vector<AreaLight> lights_at_start_;
  const std::size_t materials_at_start_;
  const bool has_paths_;
  Names objects_, lights_;  // of the document by name; kAmbiguous where several have it
  Names live_names_;
  std::vector<Live> live_;
  std::vector<std::uint32_t> free_live_, free_slots_;
  std::vector<std::uint32_t> own_material_;  // per slot: its changed material, or none
  std::vector<ModelPose> models_;
  std::size_t timeline_next_ = 0;
  bool relit_ = false;  // lights are not those at the start
  SceneState state_;
};

}  // namespace herr
