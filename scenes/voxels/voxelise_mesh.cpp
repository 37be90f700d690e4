#include "scenes/voxels/voxelise_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <unordered_map>
#include <utility>

#include "scenes/gltf/load_gltf.h"
#include "scenes/voxels/triangle_voxels.h"
#include "scenes/voxels/voxel_limits.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

// The box of a flat mesh still has this share of its longest side along each axis, so
// that it fills one voxel.
constexpr double kThinnestShare = 1e-6;

float linear_of(std::uint8_t srgb) {
  const float c = static_cast<float>(srgb) / 255.0f;
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

std::uint32_t srgb_of(float linear) {
  const float c = std::clamp(linear, 0.0f, 1.0f);
  const float encoded = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
  return static_cast<std::uint32_t>(std::lround(255.0f * encoded));
}

int wrapped(float coordinate, int size, TextureWrap wrap) {
  const auto cell = static_cast<std::int64_t>(std::floor(std::clamp(double{coordinate}, -1e6, 1e6) * size));
  const std::int64_t n = size;
  if (wrap == TextureWrap::clamp) return static_cast<int>(std::clamp<std::int64_t>(cell, 0, n - 1));
  const std::int64_t period = wrap == TextureWrap::mirror ? 2 * n : n;
  const std::int64_t within = ((cell % period) + period) % period;
  return static_cast<int>(within < n ? within : period - 1 - within);
}

glm::vec3 texel(const TextureImage& image, const glm::vec2& uv) {
  const auto x = static_cast<std::size_t>(wrapped(uv.x, image.width_px, image.wrap_u)),
             y = static_cast<std::size_t>(wrapped(uv.y, image.height_px, image.wrap_v));
  const std::uint8_t* rgba = &image.rgba[4 * (y * static_cast<std::size_t>(image.width_px) + x)];
  glm::vec3 colour{0.0f};
  for (int channel = 0; channel < 3; ++channel) {
    colour[channel] = image.srgb ? linear_of(rgba[channel]) : static_cast<float>(rgba[channel]) / 255.0f;
  }
  return colour;
}

// Sums of linear colours per voxel, in bricks as the grid has them.
class ColourSums {
 public:
  explicit ColourSums(const VoxelGrid& grid) : grid_(grid) {}

  void add(const glm::ivec3& voxel, const glm::vec3& colour) {
    Sum& sum = bricks_[grid_.block_index(voxel / kBrickSide)][VoxelGrid::place_in_brick(voxel)];
    sum.colour += colour;
    sum.count += 1;
  }
  std::size_t bricks() const { return bricks_.size(); }

  void store(VoxelGrid& grid) const {
    // In the order of blocks, whatever order the map has: the same bytes each time.
    for (std::size_t block = 0; block < grid.brick_of.size(); ++block) {
      const auto found = bricks_.find(block);
      if (found == bricks_.end()) continue;
      grid.brick_of[block] = static_cast<std::uint32_t>(grid.bricks.size());
      VoxelGrid::Brick& brick = grid.bricks.emplace_back();
      for (std::size_t i = 0; i < brick.size(); ++i) brick[i] = found->second[i].rgba();
    }
  }

 private:
  struct Sum {
    glm::vec3 colour{0.0f};
    float count = 0;
    std::uint32_t rgba() const {
      if (count == 0) return 0;
      const glm::vec3 mean = colour / count;
      return 0xff000000u | srgb_of(mean.z) << 16 | srgb_of(mean.y) << 8 | srgb_of(mean.x);
    }
  };
  const VoxelGrid& grid_;
  std::unordered_map<std::size_t, std::array<Sum, 64>> bricks_;
};

class Voxeliser {
 public:
  Voxeliser(const std::filesystem::path& file, const Scene& model, const glm::dvec3& lower, double voxel_m,
            const VoxelGrid& grid)
      : file_(file), model_(model), lower_(lower), voxel_m_(voxel_m), counts_(grid.counts), sums_(grid) {}

  void add(const Instance& instance) {
    const TriangleMesh& mesh = model_.meshes[instance.mesh];
    const Material& material = model_.materials[instance.material];
    for (const auto& corners : mesh.triangles) {
      TriangleCorners triangle;
      for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 p(mesh.positions[corners[i]]);
        triangle[i] = (glm::dvec3(instance.world_from_object * glm::dvec4(p, 1.0)) - lower_) / voxel_m_;
      }
      steps_ += column_count(triangle, counts_);
      if (steps_ > kMaxVoxeliserSteps) fail("needs more than 2^31 steps");
      for_each_touched(triangle, counts_, [&](const glm::ivec3& voxel) {
        sums_.add(voxel, colour_at(mesh, material, corners, triangle, glm::dvec3(voxel) + 0.5));
      });
      if (static_cast<std::int64_t>(sums_.bricks()) > kMaxFileBricks / 8)
        fail("fills more than a million bricks");
    }
  }
  void store(VoxelGrid& grid) const { sums_.store(grid); }

 private:
  glm::vec3 colour_at(const TriangleMesh& mesh, const Material& material,
                      const std::array<std::uint32_t, 3>& corners, const TriangleCorners& triangle,
                      const glm::dvec3& point) const {
    if (material.base_colour_texture < 0 || mesh.uvs.empty()) return material.base_colour;
    const glm::vec3 weights(nearest_weights(triangle, point));
    const glm::vec2 uv = weights.x * mesh.uvs[corners[0]] + weights.y * mesh.uvs[corners[1]] +
                         weights.z * mesh.uvs[corners[2]];
    return material.base_colour *
           texel(model_.textures[static_cast<std::size_t>(material.base_colour_texture)], uv);
  }
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(file_, 0, problem + " to be made of voxels", "write a smaller resolution");
  }

  const std::filesystem::path& file_;
  const Scene& model_;
  glm::dvec3 lower_;
  double voxel_m_;
  glm::ivec3 counts_;
  ColourSums sums_;
  std::int64_t steps_ = 0;
};

}  // namespace

VoxelisedMesh append_voxelised_mesh(const std::filesystem::path& gltf_file, int resolution, Scene& scene) {
  Scene model;
  model.instances = append_gltf(gltf_file, model).instances;
  scene.files.insert(scene.files.end(), model.files.begin(), model.files.end());
  scene.warnings.insert(scene.warnings.end(), model.warnings.begin(), model.warnings.end());
  if (model.instances.empty()) {
    throw InputError(gltf_file, 0, "has no triangles to be made of voxels", "name a model with meshes");
  }
  const Bounds box = scene_bounds(model);
  const glm::dvec3 extent = box.upper - box.lower;
  const double longest = std::max({extent.x, extent.y, extent.z});
  const double voxel_m = longest / resolution;
  if (!(voxel_m >= kMinVoxel_m)) {
    throw InputError(gltf_file, 0, "is too small to be made of voxels", "check its units and scales");
  }
  VoxelGrid grid;
  grid.name = gltf_file.stem().string();
  grid.allocate(glm::clamp(glm::ivec3(glm::ceil(extent / voxel_m - kThinnestShare)), glm::ivec3(1),
                           glm::ivec3(resolution)));
  Voxeliser voxeliser(gltf_file, model, box.lower, voxel_m, grid);
  for (const Instance& instance : model.instances) voxeliser.add(instance);
  voxeliser.store(grid);

  VoxelisedMesh made;
  made.grid = static_cast<std::uint32_t>(scene.voxel_grids.size());
  made.gltf_from_grid = {glm::dvec3{voxel_m, 0, 0}, glm::dvec3{0, voxel_m, 0}, glm::dvec3{0, 0, voxel_m},
                         box.lower};
  scene.voxel_grids.push_back(std::move(grid));
  return made;
}

}  // namespace herr
