#include "scenes/document/parse_change.h"

#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "scenes/document/document_limits.h"
#include "scenes/document/scene_document_parts.h"
#include "sessions/files/input_error.h"
#include "sessions/files/nearest_name.h"

namespace herr {
namespace {

constexpr std::array kKinds{ChangeKind::spawn,     ChangeKind::remove,       ChangeKind::move,
                            ChangeKind::set_light, ChangeKind::set_material, ChangeKind::replace_mesh};

ChangeKind parse_kind(const JsonObject& object) {
  const std::string op = object.text("op");
  std::vector<std::string> known;
  for (const ChangeKind kind : kKinds) {
    if (op == name_of(kind)) return kind;
    known.emplace_back(name_of(kind));
  }
  const std::string nearest = nearest_name(op, known);
  object.fail("op", "is \"" + printable(op) + "\"",
              "write spawn, remove, move, set_light, set_material or replace_mesh" +
                  (nearest.empty() ? "" : "; the nearest is " + nearest));
}

LightChange parse_light_change(const JsonObject& object) {
  LightChange change;
  if (object.has("intensity_w_sr") && object.has("irradiance_w_m2")) {
    object.fail("irradiance_w_m2", "stands beside intensity_w_sr", "write the one that the light's kind has");
  }
  if (object.has("intensity_w_sr"))
    change.intensity_w_sr = glm::vec3(object.vec3("intensity_w_sr", 0, kStrongest_w_sr));
  if (object.has("irradiance_w_m2"))
    change.intensity_w_sr = glm::vec3(object.vec3("irradiance_w_m2", 0, kBrightest));
  if (object.has("centre")) change.centre = object.vec3("centre", -kFarthestPlace_m, kFarthestPlace_m);
  if (object.has("size")) change.size = glm::vec3(object.vec3("size", 0, kLargest_m));
  if (object.has("direction")) {
    const glm::dvec3 direction = object.vec3("direction", -kFarthestPlace_m, kFarthestPlace_m);
    const double length = glm::length(direction);
    if (!(length > 1e-9)) object.fail("direction", "is 0", "write the vector along which the light shines");
    change.direction = direction / length;
  }
  if (object.has("virtual")) change.is_virtual = object.boolean_or("virtual", false);
  if (!change.intensity_w_sr && !change.centre && !change.size && !change.direction && !change.is_virtual) {
    object.fail(nullptr, "changes nothing about the light",
                "write intensity_w_sr, centre, size, direction or virtual");
  }
  return change;
}

}  // namespace

const char* name_of(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::spawn:
      return "spawn";
    case ChangeKind::remove:
      return "remove";
    case ChangeKind::move:
      return "move";
    case ChangeKind::set_light:
      return "set_light";
    case ChangeKind::set_material:
      return "set_material";
    case ChangeKind::replace_mesh:
      return "replace_mesh";
  }
  return "unknown";
}

SceneChange parse_change(const JsonObject& object, const char* stamp_key) {
  SceneChange change;
  change.kind = parse_kind(object);
  switch (change.kind) {
    case ChangeKind::spawn:
      object.allow_only({stamp_key, "op", "name", "of", "translation", "rotation_xyzw", "scale", "material"});
      break;
    case ChangeKind::remove:
      object.allow_only({stamp_key, "op", "name"});
      break;
    case ChangeKind::move:
      object.allow_only({stamp_key, "op", "name", "translation", "rotation_xyzw", "scale"});
      break;
    case ChangeKind::set_light:
      object.allow_only({stamp_key, "op", "name", "intensity_w_sr", "irradiance_w_m2", "centre", "size",
                         "direction", "virtual"});
      break;
    case ChangeKind::set_material:
      object.allow_only({stamp_key, "op", "name", "material"});
      break;
    case ChangeKind::replace_mesh:
      object.allow_only({stamp_key, "op", "name", "of"});
      break;
  }
  change.name = object.text("name");
  if (change.name.empty()) object.fail("name", "is empty", "name the object or light that changes");
  if (change.kind == ChangeKind::spawn || change.kind == ChangeKind::replace_mesh)
    change.of = object.text("of");
  if (change.kind == ChangeKind::spawn || change.kind == ChangeKind::move)
    change.placement = parse_placement_change(object);
  if (change.kind == ChangeKind::move && !change.placement.any())
    object.fail(nullptr, "moves nothing", "write translation, rotation_xyzw or scale");
  if (change.kind == ChangeKind::set_light) change.light = parse_light_change(object);
  if (change.kind == ChangeKind::set_material || (change.kind == ChangeKind::spawn && object.has("material")))
    change.material = parse_material_override(object.object("material"));
  return change;
}

std::vector<SceneChange> parse_timeline(const JsonObject& document) {
  std::vector<SceneChange> timeline;
  for (const JsonObject& entry : document.objects("timeline")) {
    SceneChange change = parse_change(entry, "t_s");
    change.time_s = entry.number("t_s", 0, kLatest_s);
    if (!timeline.empty() && change.time_s < timeline.back().time_s)
      entry.fail("t_s", "goes backwards", "sort the timeline by time");
    timeline.push_back(std::move(change));
  }
  return timeline;
}

SceneChange parse_event(const std::string& json, const std::filesystem::path& file, std::int64_t line,
                        TimeNs start_ns) {
  const JsonDocument document(json, file, line);
  const JsonObject object = document.root();
  SceneChange change = parse_change(object, "t_ns");
  change.time_s =
      static_cast<double>(object.integer("t_ns", 0, 4'000'000'000'000'000'000) - start_ns) * kSecondsPerNs;
  return change;
}

}  // namespace herr
