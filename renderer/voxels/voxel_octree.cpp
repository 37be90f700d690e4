#include "renderer/voxels/voxel_octree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace herr {
namespace {

std::uint32_t byte_of(float value) {
  return static_cast<std::uint32_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

std::uint32_t srgb_byte(float linear) {
  const float c = std::clamp(linear, 0.0f, 1.0f);
  return byte_of(c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f);
}

std::size_t place_of(const glm::ivec3& node) {
  return VoxelGrid::place_in_brick(node);
}

// visit(block, corner) for each of the 2x2x2 corners of each block.
template <typename Visit>
void for_each_corner(const glm::ivec3& blocks, const Visit& visit) {
  for (int z = 0; z < blocks.z; ++z) {
    for (int y = 0; y < blocks.y; ++y) {
      for (int x = 0; x < blocks.x; ++x) {
        for (int i = 0; i < 8; ++i) visit(glm::ivec3{x, y, z}, glm::ivec3{i & 1, i >> 1 & 1, i >> 2});
      }
    }
  }
}

// Faces of eight children (at x + 2 (y + 2 z); null: empty) of `side` x `side` columns, one face after the
// other along x, y and z -> those of their parent. Of two children that lie behind one another both hide.
void join_columns(const std::array<const std::uint8_t*, 8>& children, std::size_t side,
                  std::uint8_t* parent) {
  const std::size_t face = side * side;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t across = axis == 0 ? 1 : 0, along = axis == 2 ? 1 : 2;
    for (std::size_t child = 0; child < 8; ++child) {
      if (children[child] == nullptr) continue;
      const std::uint8_t* from = children[child] + axis * face;
      const std::size_t left = (child >> across & 1) * side, top = (child >> along & 1) * side;
      for (std::size_t j = 0; j < side; ++j) {
        std::uint8_t* to = parent + axis * 4 * face + (top + j) * 2 * side + left;
        for (std::size_t i = 0; i < side; ++i) {
          const unsigned passes = (255u - to[i]) * (255u - from[j * side + i]);
          to[i] = static_cast<std::uint8_t>(255u - (passes + 127u) / 255u);
        }
      }
    }
  }
}

}  // namespace

const std::array<float, 256>& linear_of_srgb() {
  static const std::array<float, 256> kTable = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double c = static_cast<double>(i) / 255.0;
      table[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return table;
  }();
  return kTable;
}

VoxelOctree::VoxelOctree(const VoxelGrid& grid) : grid_(&grid) {
  add_grid();
  for (Nodes nodes; levels_.back().nodes != glm::ivec3(1);) {
    Nodes coarser;
    add_level(nodes, coarser);
    nodes = std::move(coarser);
  }
  measure_empty_blocks();
}

std::int64_t VoxelOctree::bytes() const {
  return static_cast<std::int64_t>(sizeof(std::uint32_t) *
                                   (blocks_.size() + masks_.size() + colours_.size() + opacities_.size()));
}

void VoxelOctree::add_grid() {
  levels_.push_back({grid_->counts, grid_->blocks(), 0});
  masks_.assign(2 * grid_->bricks.size(), 0);
  for (std::size_t brick = 0; brick < grid_->bricks.size(); ++brick) {
    for (std::size_t place = 0; place < 64; ++place) {
      if (grid_->bricks[brick][place] >> 24 != 0) masks_[2 * brick + place / 32] |= 1u << place % 32;
    }
  }
  blocks_.reserve(grid_->brick_of.size());
  for (const std::uint32_t brick : grid_->brick_of) {
    const bool empty =
        brick == kNoBrick || (masks_[2 * std::size_t{brick}] | masks_[2 * std::size_t{brick} + 1]) == 0;
    blocks_.push_back(empty ? kEmptyBlock : brick);
  }
}

VoxelOctree::Node VoxelOctree::child(const Nodes& finer, std::uint32_t brick, std::size_t place,
                                     std::array<std::uint8_t, 3>& own) const {
  if (!finer.bricks.empty()) return finer.bricks[brick][place];
  const std::uint32_t rgba = grid_->bricks[brick][place];
  if (rgba >> 24 == 0) return {};
  Node node;
  node.coverage = static_cast<float>(rgba >> 24) / 255.0f;
  const auto& linear = linear_of_srgb();
  node.premultiplied =
      node.coverage * glm::vec3(linear[rgba & 255], linear[rgba >> 8 & 255], linear[rgba >> 16 & 255]);
  own.fill(static_cast<std::uint8_t>(rgba >> 24));
  node.columns = own.data();
  return node;
}

std::uint32_t VoxelOctree::add_brick() {
  masks_.resize(masks_.size() + 2, 0);
  colours_.resize(colours_.size() + 64, 0);
  opacities_.resize(opacities_.size() + 64, 0);
  return static_cast<std::uint32_t>(masks_.size() / 2 - 1);
}

void VoxelOctree::store(std::uint32_t brick, std::size_t place, const Node& node, int k) {
  masks_[2 * std::size_t{brick} + place / 32] |= 1u << place % 32;
  const std::size_t at = 64 * (std::size_t{brick} - grid_->bricks.size()) + place;
  const glm::vec3 colour = node.premultiplied / node.coverage;
  colours_[at] = srgb_byte(colour.x) | srgb_byte(colour.y) << 8 | srgb_byte(colour.z) << 16 |
                 byte_of(node.coverage) << 24;
  const std::size_t columns = std::size_t{1} << 2 * k;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::uint8_t* face = node.columns + axis * columns;
    const auto sum = std::accumulate(face, face + columns, std::size_t{0});
    opacities_[at] |= static_cast<std::uint32_t>((sum + columns / 2) / columns) << 8 * axis;
  }
}

// Each brick of the last level becomes 2x2x2 nodes of the next, kept in `coarser` before they are rounded.
void VoxelOctree::add_level(const Nodes& finer, Nodes& coarser) {
  const int k = levels();
  const Level below = levels_.back();
  const auto first_below = static_cast<std::uint32_t>(k == 1 ? 0 : masks_.size() / 2 - finer.bricks.size());
  const auto first = static_cast<std::uint32_t>(masks_.size() / 2);
  Level here;
  here.nodes = (below.nodes + 1) / 2;
  here.blocks = (here.nodes + (kBrickSide - 1)) / kBrickSide;
  here.first_block = static_cast<std::int32_t>(blocks_.size());
  levels_.push_back(here);
  blocks_.resize(blocks_.size() + static_cast<std::size_t>(here.blocks.x * here.blocks.y * here.blocks.z),
                 kEmptyBlock);
  // All columns at once: nodes point into them.
  const auto most_nodes = static_cast<std::size_t>(std::count_if(
                              blocks_.begin() + below.first_block, blocks_.begin() + here.first_block,
                              [](std::uint32_t block) { return (block & kEmptyBlock) == 0; })) *
                          8;
  const std::size_t node_columns = std::size_t{3} << 2 * k;
  coarser.columns.resize(most_nodes * node_columns);
  std::uint8_t* columns = coarser.columns.data();
  for_each_corner(below.blocks, [&](const glm::ivec3& block, const glm::ivec3& corner) {
    const std::uint32_t from = blocks_[block_index(k - 1, block)];
    if ((from & kEmptyBlock) != 0) return;
    Node mean;
    std::array<Node, 8> children;
    std::array<std::array<std::uint8_t, 3>, 8> own{};
    for (std::size_t i = 0; i < 8; ++i) {
      const auto bits = static_cast<int>(i);
      const glm::ivec3 place = 2 * corner + glm::ivec3{bits & 1, bits >> 1 & 1, bits >> 2};
      children[i] = child(finer, from - first_below, place_of(place), own[i]);
      mean.premultiplied += children[i].premultiplied / 8.0f;
      mean.coverage += children[i].coverage / 8.0f;
    }
    if (!(mean.coverage > 0)) return;
    std::array<const std::uint8_t*, 8> faces{};
    for (std::size_t i = 0; i < 8; ++i) faces[i] = children[i].columns;
    join_columns(faces, std::size_t{1} << (k - 1), columns);
    mean.columns = columns;
    columns += node_columns;
    const glm::ivec3 at = 2 * block + corner;
    std::uint32_t& to = blocks_[block_index(k, at / kBrickSide)];
    if ((to & kEmptyBlock) != 0) {
      to = add_brick();
      coarser.bricks.emplace_back();
    }
    coarser.bricks[to - first][place_of(at)] = mean;
    store(to, place_of(at), mean, k);
  });
}

std::size_t VoxelOctree::block_index(int k, const glm::ivec3& b) const {
  const Level& of = level(k);
  return static_cast<std::size_t>(of.first_block) + static_cast<std::size_t>(b.x) +
         static_cast<std::size_t>(of.blocks.x) *
             (static_cast<std::size_t>(b.y) +
              static_cast<std::size_t>(of.blocks.y) * static_cast<std::size_t>(b.z));
}

bool VoxelOctree::has_node(int k, const glm::ivec3& node) const {
  const std::uint32_t brick = blocks_[block_index(k, node / kBrickSide)];
  if ((brick & kEmptyBlock) != 0) return false;
  const std::size_t place = place_of(node);
  return (masks_[2 * std::size_t{brick} + place / 32] >> place % 32 & 1) != 0;
}

// A block of level k is a node of level k + 2; the empty cube around it doubles while that node's ancestors
// are empty too.
void VoxelOctree::measure_empty_blocks() {
  for (int k = 0; k < levels(); ++k) {
    const glm::ivec3 blocks = level(k).blocks;
    for (int z = 0; z < blocks.z; ++z) {
      for (int y = 0; y < blocks.y; ++y) {
        for (int x = 0; x < blocks.x; ++x) {
          std::uint32_t& block = blocks_[block_index(k, {x, y, z})];
          if ((block & kEmptyBlock) == 0) continue;
          std::uint32_t doublings = 0;
          for (int up = 1; k + 2 + up < levels(); ++up) {
            if (has_node(k + 2 + up, {x >> up, y >> up, z >> up})) break;
            doublings = static_cast<std::uint32_t>(up);
          }
          block = kEmptyBlock | doublings;
        }
      }
    }
  }
}

}  // namespace herr
