// How much the nodes of a .vox scene graph show, before anything is placed. The graph has no cycles but is
// no tree: a shape or group below several parents counts below each, so that a small file may ask for more
// models than any memory holds. Before: vox_file. After: vox_graph walks what is within the limits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

#include "scenes/voxels/vox_file.h"

namespace herr {

// Of a node and all below it, with what is below it several times counted as often.
struct VoxTally {
  std::int64_t models = 0, voxels = 0;  // shown
  std::int64_t hidden = 0;              // models that are not
  int height = 0;                       // nodes on the longest way down
};

// Of every node that the first one reaches. Counts end at 2^60. Throws InputError: a node or model that does
// not exist, a node that is its own ancestor, more levels, models or voxels than voxel_limits.h allows.
std::map<std::int32_t, VoxTally> tally_vox_graph(const VoxFile& vox, const std::filesystem::path& file);

}  // namespace herr
