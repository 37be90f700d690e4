#include "scenes/changes/check_changes.h"

#include <limits>
#include <string>

#include "scenes/changes/world.h"
#include "scenes/document/parse_change.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"
#include "sessions/text/written_order.h"

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

constexpr const char* kTurn = "rotation_xyzw";

// As it is written, where the change holds it normalised.
std::optional<InputError> doubt_of(const std::array<double, 4>& written, const std::filesystem::path& file,
                                   std::int64_t line) {
  const auto doubt = order_doubt(written);
  if (!doubt) return std::nullopt;
  return InputError(file, line, std::string("field ") + kTurn + " " + doubt->problem, doubt->remedy);
}

}  // namespace

struct ChangeRehearsal::Stage {
  explicit Stage(const Scene& whole) : scene(names_and_places(whole)), world(scene) {}
  Scene scene;
  World world;
  std::array<std::int64_t, 6> counts{};
  std::optional<InputError> first_doubt;
  std::int64_t doubts = 0;
};

ChangeRehearsal::ChangeRehearsal(const Scene& scene) : stage_(std::make_unique<Stage>(scene)) {}
ChangeRehearsal::~ChangeRehearsal() = default;

void ChangeRehearsal::play(const std::string& json, const std::filesystem::path& file, std::int64_t line,
                           TimeNs start_ns) {
  const SceneChange change = parse_event(json, file, line, start_ns);
  if (const auto& turn = change.placement.rotation;
      turn && order_doubt({turn->x, turn->y, turn->z, turn->w}) && stage_->doubts++ == 0) {
    stage_->first_doubt = doubt_of(JsonDocument(json, file, line).root().unit_quaternion(kTurn), file, line);
  }
  if (const auto problem = stage_->world.apply(change)) {
    throw InputError(file, line, std::string(name_of(change.kind)) + " " + problem->what, problem->remedy);
  }
  ++stage_->counts[static_cast<std::size_t>(change.kind)];
}

void ChangeRehearsal::finish() {
  stage_->world.advance(std::numeric_limits<double>::max());
}

std::optional<InputError> ChangeRehearsal::w_first_warning() const {
  const auto& first = stage_->first_doubt;
  if (!first || stage_->doubts < 2) return first;
  return InputError(first->file(), first->line(),
                    first->problem() + " (and " + std::to_string(stage_->doubts - 1) + " more)",
                    first->remedy());
}

const std::array<std::int64_t, 6>& ChangeRehearsal::counts() const {
  return stage_->counts;
}

void check_timeline(const Scene& scene) {
  ChangeRehearsal(scene).finish();
}

}  // namespace herr
