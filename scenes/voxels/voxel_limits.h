// Bounds on what one file of voxels may ask for, checked before memory is taken. Used by
// every reader of this folder.
#pragma once

#include <cstdint>

namespace herr {

inline constexpr std::int64_t kMaxVoxBytes = 512ll << 20;      // of a .vox file
inline constexpr int kMaxVoxSide = 256;                        // of a model: its coordinates are bytes
inline constexpr std::int64_t kMaxVoxNodes = 1'000'000;        // of the scene graph
inline constexpr int kMaxVoxDepth = 64;                        // of the scene graph
inline constexpr std::int64_t kMaxPlacedModels = 1'000'000;    // of a file: a shared group multiplies them
inline constexpr std::int64_t kMaxPlacedVoxels = 64ll << 30;   // of all these models
inline constexpr std::int64_t kMaxFileBlocks = 64ll << 20;     // 4x4x4 blocks of all grids of a file: 256 MiB
inline constexpr std::int64_t kMaxFileBricks = 8ll << 20;      // of those, with voxels: 2 GiB
inline constexpr std::int64_t kMaxRawVoxels = 256ll << 20;     // of a raw grid: a file of 1 GiB
inline constexpr int kMaxMeshResolution = 512;                 // voxels along a mesh's longest side
inline constexpr std::int64_t kMaxVoxeliserSteps = 2ll << 30;  // columns of voxels under all triangles

inline constexpr double kMinVoxel_m = 1e-12, kMaxVoxel_m = 1e9;  // edge of a voxel

}  // namespace herr
