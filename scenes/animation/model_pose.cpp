#include "scenes/animation/model_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/model/placement.h"
#include "scenes/model/transform_checks.h"

namespace herr {
namespace {

using Quaternion = glm::dquat;

Quaternion quaternion_of(const float* v) {
  const Quaternion q(double{v[3]}, double{v[0]}, double{v[1]}, double{v[2]});
  const double length = glm::length(q);
  return length > 1e-12 ? q / length : Quaternion(1, 0, 0, 0);
}

void store(const Quaternion& q, float* out) {
  out[0] = static_cast<float>(q.x);
  out[1] = static_cast<float>(q.y);
  out[2] = static_cast<float>(q.z);
  out[3] = static_cast<float>(q.w);
}

// Hermite's cubic between two keys, tangents scaled by the time between them (glTF 2.0, appendix C.5).
void cubic(const AnimationChannel& channel, std::size_t key, double t, double span_s, float* out) {
  const auto n = static_cast<std::size_t>(channel.components);
  const float* a = &channel.values[3 * n * key];  // in-tangent, value, out-tangent
  const float* b = a + 3 * n;
  const double t2 = t * t, t3 = t2 * t;
  for (std::size_t i = 0; i < n; ++i) {
    out[i] = static_cast<float>((2 * t3 - 3 * t2 + 1) * double{a[n + i]} +
                                span_s * (t3 - 2 * t2 + t) * double{a[2 * n + i]} +
                                (-2 * t3 + 3 * t2) * double{b[n + i]} + span_s * (t3 - t2) * double{b[i]});
  }
}

void linear(const AnimationChannel& channel, std::size_t key, double t, float* out) {
  const auto n = static_cast<std::size_t>(channel.components);
  const float* a = &channel.values[n * key];
  const float* b = a + n;
  if (channel.value == AnimatedValue::rotation) {
    store(glm::slerp(quaternion_of(a), quaternion_of(b), t), out);
    return;
  }
  for (std::size_t i = 0; i < n; ++i)
    out[i] = static_cast<float>(double{a[i]} + t * (double{b[i]} - double{a[i]}));
}

glm::dmat4x3 local_matrix(const ModelNode& node) {
  if (node.has_matrix) return node.parent_from_node;
  return Placement{node.translation, node.rotation, node.scale}.matrix();
}

}  // namespace

double clip_time_s(const Playback& playback, double length_s, double time_s) {
  const double t = playback.offset_s + playback.speed * time_s;
  if (!playback.loop) return std::clamp(t, 0.0, length_s);
  if (!(length_s > 0)) return 0;
  const double rest = std::fmod(t, length_s);
  return rest < 0 ? rest + length_s : rest;
}

void sample_channel(const AnimationChannel& channel, double time_s, float* out) {
  const std::vector<float>& times = channel.times_s;
  const auto n = static_cast<std::size_t>(channel.components);
  const bool spline = channel.interpolation == Interpolation::cubic_spline;
  const auto value_of = [&](std::size_t key) {
    return &channel.values[spline ? (3 * key + 1) * n : key * n];
  };
  const auto after = std::upper_bound(times.begin(), times.end(), time_s,
                                      [](double t, float key) { return t < double{key}; });
  const auto next = static_cast<std::size_t>(after - times.begin());
  if (next == 0 || next == times.size() || channel.interpolation == Interpolation::step) {
    std::copy_n(value_of(next == 0 ? 0 : next - 1), n, out);
  } else {
    const double from_s = double{times[next - 1]}, span_s = double{times[next]} - from_s;
    const double t = (time_s - from_s) / span_s;
    if (spline)
      cubic(channel, next - 1, t, span_s, out);
    else
      linear(channel, next - 1, t, out);
  }
  if (channel.value == AnimatedValue::rotation) store(quaternion_of(out), out);
}

ModelPose::ModelPose(const AnimatedModel& model)
    : model_(model), nodes_(model.nodes), matrices_(model.nodes.size(), glm::dmat4x3(1.0)) {
  std::size_t widest = 4;
  for (const AnimationClip& clip : model.clips) {
    for (const AnimationChannel& channel : clip.channels)
      widest = std::max(widest, static_cast<std::size_t>(channel.components));
  }
  sampled_.resize(widest);
  pose(0);
}

void ModelPose::pose(double time_s) {
  if (model_.playback.clip >= 0) {
    const AnimationClip& clip = model_.clips[static_cast<std::size_t>(model_.playback.clip)];
    const double t = clip_time_s(model_.playback, clip.length_s, time_s);
    for (const AnimationChannel& channel : clip.channels) {
      sample_channel(channel, t, sampled_.data());
      ModelNode& node = nodes_[static_cast<std::size_t>(channel.node)];
      const float* v = sampled_.data();
      switch (channel.value) {
        case AnimatedValue::translation:
          node.translation = {double{v[0]}, double{v[1]}, double{v[2]}};
          break;
        case AnimatedValue::rotation:
          node.rotation = quaternion_of(v);
          break;
        case AnimatedValue::scale:
          node.scale = {double{v[0]}, double{v[1]}, double{v[2]}};
          break;
        case AnimatedValue::weights:
          std::copy_n(v, std::min(node.weights.size(), static_cast<std::size_t>(channel.components)),
                      node.weights.begin());
          break;
      }
    }
  }
  for (const int index : model_.order) {
    const auto i = static_cast<std::size_t>(index);
    const int parent = nodes_[i].parent;
    const glm::dmat4x3 local = local_matrix(nodes_[i]);
    matrices_[i] = parent < 0 ? local : compose(matrices_[static_cast<std::size_t>(parent)], local);
  }
}

void ModelPose::bend(const MeshDeformation& deformation, DeformationPose& out) const {
  bool changed = false;
  if (deformation.skin >= 0) {
    const ModelSkin& skin = model_.skins[static_cast<std::size_t>(deformation.skin)];
    changed = out.joints.size() != skin.joints.size();
    out.joints.resize(skin.joints.size());
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
      const glm::dmat4x3 m = compose(model_from_node(skin.joints[i]), skin.joint_from_mesh[i]);
      std::array<float, 12> columns{};
      for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row)
          columns[static_cast<std::size_t>(3 * column + row)] = static_cast<float>(m[column][row]);
      }
      changed = changed || columns != out.joints[i];
      out.joints[i] = columns;
    }
  }
  const std::vector<float>& weights = nodes_[static_cast<std::size_t>(deformation.node)].weights;
  if (!deformation.targets.empty() && weights != out.weights) {
    out.weights = weights;
    changed = true;
  }
  if (changed) ++out.version;
}

}  // namespace herr
