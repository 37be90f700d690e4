// Bounds on what one glTF file may ask for, checked before memory is taken. A file within them needs at most
// a few gigabytes; a crafted file that declares more is refused by name. Used by every stage of this folder.
#pragma once

#include <cstdint>

namespace herr {

inline constexpr std::int64_t kMaxGltfBytes = 512ll
                                              << 20;  // .gltf or .glb itself; tinygltf counts in 32 bits
inline constexpr std::int64_t kMaxExternalBytes = 1ll << 30;  // all buffers and images beside it together
inline constexpr int kMaxJsonDepth = 64;                      // tinygltf recurses over `extras`
inline constexpr std::int64_t kMaxJsonValues = 5'000'000;
inline constexpr std::int64_t kMaxElements = 32'000'000;       // elements of one accessor
inline constexpr std::int64_t kMaxFileVertices = 32'000'000;   // of all primitives of a file
inline constexpr std::int64_t kMaxFileTriangles = 32'000'000;  // of all primitives of a file
inline constexpr std::int64_t kMaxInstances = 1'000'000;       // after flattening the node tree
inline constexpr std::int64_t kMaxImagePixels = 64ll << 20;    // one image: 256 MiB as RGBA8
inline constexpr int kMaxImageSide_px = 16384;                 // the contract of TextureImage
inline constexpr double kLargestTransform = 1e30;              // of any number that becomes part of a matrix
inline constexpr std::int64_t kMaxTextureBytes = 1ll << 30;    // all decoded textures of a scene

}  // namespace herr
