#include "scenes/voxels/load_vox.h"

#include <charconv>
#include <map>
#include <string>

#include "scenes/model/transform_checks.h"
#include "scenes/voxels/vox_file.h"
#include "scenes/voxels/vox_graph.h"
#include "scenes/voxels/voxel_limits.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

// x, y, z of the file (z up) -> x, z, -y.
const glm::dmat4x3 kYUpFromZUp{glm::dvec3{1, 0, 0}, glm::dvec3{0, 0, -1}, glm::dvec3{0, 1, 0},
                               glm::dvec3{0.0}};

// A property of a material in [0, 1]; none where it is absent or no number.
double property(const VoxDictionary& material, const char* key, double fallback) {
  const auto found = material.find(key);
  if (found == material.end()) return fallback;
  const std::string& text = found->second;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && value >= 0 && value <= 1 ? value : fallback;
}

// Coverage per colour: glass lets through what its material says, everything else nothing. `left_out` counts
// materials whose other properties are not used.
std::array<std::uint32_t, 256> colours_of(const VoxFile& vox, int& left_out) {
  std::array<std::uint32_t, 256> colours = vox.palette;
  colours[0] = 0;
  for (const auto& [index, material] : vox.materials) {
    const auto type = material.find("_type");
    if (type == material.end() || type->second == "_diffuse") continue;
    if (type->second != "_glass") {
      ++left_out;
      continue;
    }
    const double passes = property(material, "_trans", property(material, "_alpha", 0.5));
    const auto coverage = static_cast<std::uint32_t>(1.5 + 254 * (1 - passes));  // never without a voxel
    std::uint32_t& colour = colours[static_cast<std::size_t>(index & 255)];
    if (index != 0) colour = (colour & 0xffffffu) | coverage << 24;
  }
  return colours;
}

VoxelGrid grid_of(const VoxModel& model, const std::array<std::uint32_t, 256>& colours) {
  VoxelGrid grid;
  grid.allocate({model.size_x, model.size_y, model.size_z});
  for (std::size_t i = 0; i < model.voxels.size(); i += 4) {
    const auto at = [&](std::size_t k) { return int{static_cast<std::uint8_t>(model.voxels[i + k])}; };
    if (at(3) != 0) grid.set({at(0), at(1), at(2)}, colours[static_cast<std::size_t>(at(3))]);
  }
  return grid;
}

// Grids of models, made when the first instance asks for them.
class GridCache {
 public:
  GridCache(const VoxFile& vox, const std::filesystem::path& file, Scene& scene)
      : vox_(vox), file_(file), scene_(scene), colours_(colours_of(vox, left_out_)) {}

  std::uint32_t grid(std::size_t model) {
    const auto [entry, added] =
        made_.try_emplace(model, static_cast<std::uint32_t>(scene_.voxel_grids.size()));
    if (!added) return entry->second;
    const VoxModel& from = vox_.models[model];
    blocks_ += block_count({from.size_x, from.size_y, from.size_z});
    if (blocks_ > kMaxFileBlocks) too_big();
    VoxelGrid& made = scene_.voxel_grids.emplace_back(grid_of(from, colours_));
    made.name = file_.stem().string() + "/" + std::to_string(model);
    bricks_ += static_cast<std::int64_t>(made.bricks.size());
    if (bricks_ > kMaxFileBricks) too_big();
    return entry->second;
  }
  int left_out() const { return left_out_; }

 private:
  [[noreturn]] void too_big() const {
    throw InputError(file_, 0, "has models that need more than 2 GiB of voxels",
                     "split it into several files");
  }

  const VoxFile& vox_;
  const std::filesystem::path& file_;
  Scene& scene_;
  int left_out_ = 0;
  std::array<std::uint32_t, 256> colours_;
  std::map<std::size_t, std::uint32_t> made_;
  std::int64_t blocks_ = 0, bricks_ = 0;
};

void warn(Scene& scene, const std::filesystem::path& file, const std::string& text) {
  scene.warnings.push_back(printable(file.string()) + ": " + text);
}

}  // namespace

std::uint32_t append_voxel_material(const std::string& name, Scene& scene) {
  Material material;
  material.name = name;
  material.base_colour = glm::vec3(1.0f);
  scene.materials.push_back(material);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

std::vector<Instance> append_vox(const std::filesystem::path& file, Scene& scene) {
  const std::string bytes = read_whole_file(file, kMaxVoxBytes);
  const VoxFile vox = parse_vox(bytes, file);
  const VoxShow show = placed_models(vox, file);
  scene.files.push_back(file);

  std::vector<Instance> instances;
  const std::uint32_t material = append_voxel_material(file.stem().string(), scene);
  GridCache grids(vox, file, scene);
  for (const PlacedModel& placed : show.models) {
    if (vox.models[placed.model].voxels.empty()) continue;
    Instance instance;
    instance.name = placed.name.empty() ? "model " + std::to_string(placed.model) : placed.name;
    instance.kind = ShapeKind::voxels;
    instance.grid = grids.grid(placed.model);
    instance.material = material;
    instance.world_from_object = compose(kYUpFromZUp, placed.vox_from_model);
    instances.push_back(instance);
  }
  if (instances.empty()) warn(scene, file, "shows nothing: it has no voxel that is not hidden");
  if (show.hidden > 0)
    warn(scene, file, counted(show.hidden, "hidden model is left out", "hidden models are left out"));
  if (show.animated > 0) {
    warn(scene, file,
         counted(static_cast<std::int64_t>(show.animated), "node moves or changes; its first frame is shown",
                 "nodes move or change; their first frame is shown"));
  }
  if (grids.left_out() > 0) {
    warn(scene, file,
         counted(static_cast<std::int64_t>(grids.left_out()),
                 "material is drawn as matte: the scene sets gloss and emission",
                 "materials are drawn as matte: the scene sets gloss and emission"));
  }
  return instances;
}

}  // namespace herr
