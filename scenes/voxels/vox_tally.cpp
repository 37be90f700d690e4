#include "scenes/voxels/vox_tally.h"

#include <algorithm>
#include <string>

#include "scenes/voxels/voxel_limits.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr std::int64_t kMostCounted = std::int64_t{1} << 60;  // two of them still add up in 64 bits
constexpr const char* kExportGraph = "export it again from MagicaVoxel";

class TallyWalk {
 public:
  TallyWalk(const VoxFile& vox, const std::filesystem::path& file) : vox_(vox), file_(file) {}

  // Each node is counted once, whatever leads to it; `depth` ends the recursion.
  const VoxTally& count(std::int32_t id, int depth) {
    const VoxNode& node = vox_.nodes.at(id);
    const auto [entry, first] = counted_.try_emplace(id);
    VoxTally& tally = entry->second;
    if (!first && tally.height == 0) fail(node, "is its own ancestor", kExportGraph);
    if (first) tally = node.kind == VoxNodeKind::shape ? of_shape(node) : of_children(node, depth);
    if (depth + tally.height > kMaxVoxDepth + 1) fail_depth(node);
    return tally;
  }

  std::map<std::int32_t, VoxTally> take() { return std::move(counted_); }

 private:
  VoxTally of_children(const VoxNode& node, int depth) {
    if (depth > kMaxVoxDepth) fail_depth(node);
    VoxTally sum;
    for (const std::int32_t child : node.children) {
      if (!vox_.nodes.contains(child)) {
        fail(node, "names node " + std::to_string(child) + ", which does not exist", kExportGraph);
      }
      const VoxTally below = count(child, depth + 1);
      sum.models = std::min(sum.models + below.models, kMostCounted);
      sum.voxels = std::min(sum.voxels + below.voxels, kMostCounted);
      sum.hidden = std::min(sum.hidden + below.hidden, kMostCounted);
      sum.height = std::max(sum.height, below.height);
    }
    const auto layer = vox_.layer_hidden.find(node.layer);
    const bool layer_hidden =
        node.kind == VoxNodeKind::transform && layer != vox_.layer_hidden.end() && layer->second;
    if (node.hidden || layer_hidden) {
      sum.hidden = std::min(sum.hidden + sum.models, kMostCounted);
      sum.models = sum.voxels = 0;
    }
    ++sum.height;
    return sum;
  }

  VoxTally of_shape(const VoxNode& node) const {
    if (node.children.empty()) return {0, 0, 0, 1};
    const std::int32_t model = node.children.front();
    if (model < 0 || static_cast<std::size_t>(model) >= vox_.models.size()) {
      fail(node, "names model " + std::to_string(model) + " of " + std::to_string(vox_.models.size()),
           kExportGraph);
    }
    const std::size_t bytes = vox_.models[static_cast<std::size_t>(model)].voxels.size();
    return {1, static_cast<std::int64_t>(bytes / 4), 0, 1};
  }

  [[noreturn]] void fail_depth(const VoxNode& node) const {
    fail(node, "lies deeper than 64 nodes", "flatten the groups");
  }
  [[noreturn]] void fail(const VoxNode& node, const std::string& problem, const char* remedy) const {
    throw InputError(file_, 0, "at byte " + std::to_string(node.offset) + " a node " + problem, remedy);
  }

  const VoxFile& vox_;
  const std::filesystem::path& file_;
  std::map<std::int32_t, VoxTally> counted_;
};

void check_limits(const VoxTally& all, const std::filesystem::path& file) {
  const auto check = [&](std::int64_t count, std::int64_t limit, const char* what) {
    if (count <= limit) return;
    const std::string number = count < kMostCounted ? std::to_string(count) : "more than 2^60";
    throw InputError(file, 0,
                     "places " + number + " " + what +
                         ": groups that are shown several times multiply, and " + std::to_string(limit) +
                         " are accepted",
                     "show the groups less often, or merge models");
  };
  check(all.models, kMaxPlacedModels, "models");
  check(all.voxels, kMaxPlacedVoxels, "voxels");
}

}  // namespace

std::map<std::int32_t, VoxTally> tally_vox_graph(const VoxFile& vox, const std::filesystem::path& file) {
  TallyWalk walk(vox, file);
  check_limits(walk.count(vox.nodes.begin()->first, 0), file);
  return walk.take();
}

}  // namespace herr
