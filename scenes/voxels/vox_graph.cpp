#include "scenes/voxels/vox_graph.h"

#include <array>
#include <charconv>
#include <glm/vec3.hpp>
#include <map>
#include <set>
#include <utility>

#include "scenes/model/transform_checks.h"
#include "scenes/voxels/vox_tally.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr int kFarthestTranslation = 1'000'000;  // voxels

[[noreturn]] void fail(const std::filesystem::path& file, const VoxNode& node, const std::string& problem,
                       const std::string& remedy) {
  throw InputError(file, 0, "at byte " + std::to_string(node.offset) + " a node " + problem, remedy);
}

// Whole numbers parted by one blank each.
template <std::size_t kCount>
bool read_integers(const std::string& text, std::array<int, kCount>& out) {
  const char *at = text.data(), *end = text.data() + text.size();
  for (std::size_t i = 0; i < kCount; ++i) {
    if (i > 0 && (at == end || *at++ != ' ')) return false;
    const auto [next, error] = std::from_chars(at, end, out[i]);
    if (error != std::errc()) return false;
    at = next;
  }
  return at == end;
}

// Bits 0-1 and 2-3: the column of the number in the first and second row; 4, 5, 6: rows that are negative.
bool set_rotation(int bits, glm::dmat4x3& matrix) {
  const int first = bits & 3, second = bits >> 2 & 3;
  if (bits < 0 || bits > 127 || first > 2 || second > 2 || first == second) return false;
  const int columns[3] = {first, second, 3 - first - second};
  for (int column = 0; column < 3; ++column) matrix[column] = glm::dvec3(0.0);
  for (int row = 0; row < 3; ++row) matrix[columns[row]][row] = (bits >> (4 + row) & 1) != 0 ? -1.0 : 1.0;
  return true;
}

glm::dmat4x3 matrix_of(const VoxNode& node, const std::filesystem::path& file) {
  glm::dmat4x3 matrix(1.0);
  if (const auto rotation = node.frame.find("_r"); rotation != node.frame.end()) {
    std::array<int, 1> bits{};
    if (!read_integers(rotation->second, bits) || !set_rotation(bits[0], matrix)) {
      fail(file, node, "has the rotation \"" + printable(rotation->second) + "\", which is none",
           "export it again from MagicaVoxel");
    }
  }
  if (const auto translation = node.frame.find("_t"); translation != node.frame.end()) {
    std::array<int, 3> t{};
    bool near = read_integers(translation->second, t);
    for (const int axis : t) near = near && axis >= -kFarthestTranslation && axis <= kFarthestTranslation;
    if (!near) {
      fail(file, node, "has the translation \"" + printable(translation->second) + "\"",
           "three whole numbers within a million voxels are accepted");
    }
    matrix[3] = glm::dvec3(t[0], t[1], t[2]);
  }
  return matrix;
}

// A model turns about its voxel floor(size / 2).
glm::dmat4x3 pivot_from_corner(const VoxModel& model) {
  glm::dmat4x3 matrix(1.0);
  matrix[3] = -glm::dvec3(model.size_x / 2, model.size_y / 2, model.size_z / 2);
  return matrix;
}

struct Visit {
  std::int32_t node;
  glm::dmat4x3 vox_from_node;
  std::string name;
};

class GraphWalk {
 public:
  GraphWalk(const VoxFile& vox, const std::filesystem::path& file)
      : vox_(vox), file_(file), tally_(tally_vox_graph(vox, file)) {}

  // What shows nothing is not entered, so that there are at most as many steps as models times depth.
  VoxShow walk() {
    const std::int32_t root = vox_.nodes.begin()->first;
    show_.hidden = tally_.at(root).hidden;
    stack_.push_back({root, glm::dmat4x3(1.0), ""});
    while (!stack_.empty()) {
      const Visit visit = std::move(stack_.back());
      stack_.pop_back();
      if (tally_.at(visit.node).models > 0) step(visit);
    }
    show_.animated = animated_.size();
    return std::move(show_);
  }

 private:
  void step(const Visit& visit) {
    const VoxNode& node = vox_.nodes.at(visit.node);
    if (node.frames > 1 || (node.kind == VoxNodeKind::shape && node.children.size() > 1)) {
      animated_.insert(visit.node);
    }
    if (node.kind == VoxNodeKind::shape) return show(node, visit);
    Visit below = visit;
    if (node.kind == VoxNodeKind::transform) {
      below.vox_from_node = compose(visit.vox_from_node, matrix_of(node, file_));
      if (!node.name.empty()) below.name = node.name;
    }
    // From the last to the first: they come off the stack in the file's order.
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
      below.node = *child;
      stack_.push_back(below);
    }
  }

  void show(const VoxNode& node, const Visit& visit) {
    const auto index = static_cast<std::size_t>(node.children.front());
    show_.models.push_back(
        {index, visit.name, compose(visit.vox_from_node, pivot_from_corner(vox_.models[index]))});
  }

  const VoxFile& vox_;
  const std::filesystem::path& file_;
  const std::map<std::int32_t, VoxTally> tally_;
  VoxShow show_;
  std::vector<Visit> stack_;
  std::set<std::int32_t> animated_;
};

}  // namespace

VoxShow placed_models(const VoxFile& vox, const std::filesystem::path& file) {
  if (!vox.nodes.empty()) return GraphWalk(vox, file).walk();
  // Without a graph: the first model, standing on the ground. Others are its later frames.
  PlacedModel only{0, "", pivot_from_corner(vox.models.front())};
  only.vox_from_model[3].z = 0;
  return {{only}, 0, vox.models.size() > 1 ? std::size_t{1} : std::size_t{0}};
}

}  // namespace herr
