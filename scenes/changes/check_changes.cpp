#include "scenes/changes/check_changes.h"

#include <limits>
#include <string>

#include "scenes/changes/world.h"
#include "scenes/document/parse_change.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

// What changes refer to, without the shapes themselves.
Scene names_and_places(const Scene& scene) {
  Scene bare;
  bare.materials = scene.materials;
  bare.instances = scene.instances;
  bare.lights = scene.lights;
  bare.objects = scene.objects;
  bare.models = scene.models;
  bare.timeline = scene.timeline;
  bare.files = scene.files;
  return bare;
}

}  // namespace

struct ChangeRehearsal::Stage {
  explicit Stage(const Scene& whole) : scene(names_and_places(whole)), world(scene) {}
  Scene scene;
  World world;
  std::array<std::int64_t, 6> counts{};
};

ChangeRehearsal::ChangeRehearsal(const Scene& scene) : stage_(std::make_unique<Stage>(scene)) {}
ChangeRehearsal::~ChangeRehearsal() = default;

void ChangeRehearsal::play(const std::string& json, const std::filesystem::path& file, std::int64_t line,
                           TimeNs start_ns) {
  const SceneChange change = parse_event(json, file, line, start_ns);
  if (const auto problem = stage_->world.apply(change)) {
    throw InputError(file, line, std::string(name_of(change.kind)) + " " + problem->what, problem->remedy);
  }
  ++stage_->counts[static_cast<std::size_t>(change.kind)];
}

void ChangeRehearsal::finish() {
  stage_->world.advance(std::numeric_limits<double>::max());
}

const std::array<std::int64_t, 6>& ChangeRehearsal::counts() const {
  return stage_->counts;
}

void check_timeline(const Scene& scene) {
  ChangeRehearsal(scene).finish();
}

}  // namespace herr
