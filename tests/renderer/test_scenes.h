// Scenes made by hand, small display profiles, and one call that renders a frame of them.
// Before: a test says what there is. After: it reads the rendered viewports.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <utility>

#include "renderer/renderer.h"
#include "renderer/settings_presets.h"
#include "tests/renderer/viewports/viewport_jobs.h"

namespace herr::test {

// Two triangles: corner, corner + u, corner + u + v, corner + v; its front looks along u x v; uv in [0, 1].
inline TriangleMesh quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
  TriangleMesh mesh;
  mesh.positions = {corner, corner + u, corner + u + v, corner + v};
  mesh.normals.assign(4, glm::normalize(glm::cross(u, v)));
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// A square of side 2 * half in the plane y = height, its front upwards.
inline TriangleMesh floor_quad(float half, float height = 0) {
  return quad({-half, height, half}, {2 * half, 0, 0}, {0, 0, -2 * half});
}

inline TriangleMesh box(const glm::vec3& lower, const glm::vec3& upper) {
  TriangleMesh mesh;
  const glm::vec3 size = upper - lower;
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 u{0}, v{0}, w{0};
    u[(axis + 1) % 3] = size[(axis + 1) % 3];
    v[(axis + 2) % 3] = size[(axis + 2) % 3];
    w[axis] = size[axis];
    for (const TriangleMesh& side : {quad(lower + w, u, v), quad(lower, v, u)}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), side.positions.begin(), side.positions.end());
      mesh.normals.insert(mesh.normals.end(), side.normals.begin(), side.normals.end());
      mesh.uvs.insert(mesh.uvs.end(), side.uvs.begin(), side.uvs.end());
      for (const auto& t : side.triangles)
        mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  }
  return mesh;
}

// Smooth normals; corners lie on the sphere.
inline TriangleMesh sphere(const glm::vec3& centre, float radius, int rings = 24, int sectors = 48) {
  TriangleMesh mesh;
  for (int i = 0; i <= rings; ++i) {
    const double polar = glm::pi<double>() * i / rings;
    for (int j = 0; j <= sectors; ++j) {
      const double azimuth = glm::two_pi<double>() * j / sectors;
      const glm::vec3 n{std::sin(polar) * std::cos(azimuth), std::cos(polar),
                        -std::sin(polar) * std::sin(azimuth)};
      mesh.positions.push_back(centre + radius * n);
      mesh.normals.push_back(n);
      mesh.uvs.push_back({static_cast<float>(j) / static_cast<float>(sectors),
                          static_cast<float>(i) / static_cast<float>(rings)});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (sectors + 1) + j); };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

inline void add(Scene& scene, TriangleMesh mesh, const Material& material, bool catcher = false,
                const glm::dmat4x3& place = glm::dmat4x3{1.0}) {
  Instance instance;
  instance.name = "instance " + std::to_string(scene.instances.size());
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.material = static_cast<std::uint32_t>(scene.materials.size());
  instance.world_from_object = place;
  instance.catcher = catcher;
  scene.meshes.push_back(std::move(mesh));
  scene.materials.push_back(material);
  scene.instances.push_back(std::move(instance));
}

inline Material matte(const glm::vec3& colour) {
  Material material;
  material.base_colour = colour;
  material.roughness = 1.0f;
  return material;
}
// Black but for what it emits (and the 4 % that every dielectric reflects).
inline Material glowing(const glm::vec3& radiance) {
  Material material = matte(glm::vec3{0.0f});
  material.emission = radiance;
  return material;
}

inline AreaLight light_at(const glm::dvec3& centre, const glm::vec3& intensity,
                          const glm::vec3& size = {0, 0, 0}) {
  AreaLight light;
  light.centre = centre;
  light.intensity_w_sr = intensity;
  light.size = size;
  return light;
}

// Per eye a context and a focus viewport, as xr1 has them.
inline DisplayProfile small_profile(int context_px = 64, int focus_width_px = 80, int focus_height_px = 48) {
  DisplayProfile profile;
  profile.name = "small";
  for (const Eye eye : kEyes) {
    profile.viewports.push_back(viewport_deg(eye, context_px, context_px, -45, 45, -45, 45));
    profile.viewports.push_back(viewport_deg(eye, focus_width_px, focus_height_px, -20, 20, -11.57, 11.57));
  }
  return profile;
}
// One viewport of the left eye.
inline DisplayProfile single_view(int width_px, int height_px, double half_width_deg,
                                  double half_height_deg) {
  DisplayProfile profile;
  profile.name = "single";
  profile.viewports = {viewport_deg(Eye::left, width_px, height_px, -half_width_deg, half_width_deg,
                                    -half_height_deg, half_height_deg)};
  return profile;
}

inline RenderSettings small_settings() {
  RenderSettings settings = direct_light_settings();
  settings.polar_width = 64;
  settings.polar_height = 48;
  settings.threads = 1;
  return settings;
}
inline RenderSettings planar_settings() {
  RenderSettings settings = small_settings();
  settings.foveation = Foveation::off;
  return settings;
}

// Both eyes at the head, so that geometry is the head's own; looking along -Z at t = 1 s.
inline FrameSample sample_from(const glm::dvec3& head, const glm::dvec3& gaze = {0, 0, -1}) {
  FrameSample sample;
  sample.t_ns = 1'000'000'000;
  sample.head.world_from_head.position = head;
  sample.gaze.head_direction = {gaze, gaze};
  return sample;
}
inline FrameSample looking_down(const glm::dvec3& head) {
  FrameSample sample = sample_from(head);
  sample.head.world_from_head.orientation = glm::angleAxis(-glm::half_pi<double>(), glm::dvec3{1, 0, 0});
  return sample;
}

// A camera of one image, which must outlive the sample.
struct TestCamera {
  CameraModel model;
  std::shared_ptr<CameraImage> image = std::make_shared<CameraImage>();

  // Pinhole of the given half field of view; every pixel is colour(x, y).
  template <typename Colour>
  static TestCamera pinhole(int width_px, int height_px, double half_width_deg, const Colour& colour) {
    TestCamera camera;
    CameraModel& m = camera.model;
    m.width_px = camera.image->width_px = width_px;
    m.height_px = camera.image->height_px = height_px;
    m.fx = m.fy = 0.5 * width_px / std::tan(half_width_deg / kDegreesPerRadian);
    m.cx = 0.5 * (width_px - 1);
    m.cy = 0.5 * (height_px - 1);
    m.prepare();
    for (int y = 0; y < height_px; ++y) {
      for (int x = 0; x < width_px; ++x) {
        const std::array<std::uint16_t, 4> texel = colour(x, y);
        camera.image->rgba_half.insert(camera.image->rgba_half.end(), texel.begin(), texel.end());
      }
    }
    return camera;
  }
  // Exposed where the head is now.
  void attach_to(FrameSample& sample) const {
    for (auto& eye : sample.cameras) {
      eye = SampledCamera{image, &model, sample.head.world_from_head, sample.t_ns, 0};
    }
  }
};

inline void render_with(Renderer& renderer, const Scene& scene, const FrameSample& sample,
                        RenderedFrame& out) {
  SceneState state;
  scene_state_at(scene, 0.0, state);
  renderer.render_frame(sample, state, out);
}

inline RenderedFrame render(const Scene& scene, const DisplayProfile& profile, const RenderSettings& settings,
                            const FrameSample& sample) {
  Renderer renderer(scene, profile, settings, sample.cameras[0].has_value());
  RenderedFrame frame;
  render_with(renderer, scene, sample, frame);
  return frame;
}

}  // namespace herr::test
