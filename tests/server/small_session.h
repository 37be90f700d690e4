// A session, a scene and a display profile of a few kilobytes, as files, for tests of the whole program.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "server/output/png_encoder.h"
#include "sessions/record/session_recorder.h"

namespace herr {

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

// One triangle two metres ahead, one light, a floor that catches its shadow.
inline void write_small_scene(const std::filesystem::path& folder) {
  write_text(folder / "triangle.gltf",
             R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AACAvwAAAAAAAADAAACAPwAAAAAAAADAAAAAAAAAAEAAAADA"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, 0, -2], "max": [1, 2, -2]}]})");
  write_text(folder / "small.scene.json", R"({"format_version": 1, "name": "small",
"gltf": [{"file": "triangle.gltf", "name": "triangle"}],
"catchers": [{"name": "floor", "quad": [[-5, 0, 5], [5, 0, 5], [5, 0, -5], [-5, 0, -5]]}],
"lights": [{"name": "lamp", "centre": [0, 3, 1], "size": [0.5, 0.1, 0.5], "intensity_w_sr": [10, 10, 10]}],
"ambient": [0.2, 0.2, 0.2]})");
}

inline void write_small_profile(const std::filesystem::path& file) {
  std::string viewports;
  for (const char* eye : {"left", "right"}) {
    for (const char* kind : {"context", "focus"}) {
      const std::string half = kind == std::string("focus") ? "15" : "45";
      viewports += std::string(viewports.empty() ? "" : ", ") + R"({"name": ")" + eye + "_" + kind +
                   R"(", "eye": ")" + eye + R"(", "kind": ")" + kind +
                   R"(", "width_px": 48, "height_px": 40, "left_deg": -)" + half + R"(, "right_deg": )" +
                   half + R"(, "down_deg": -)" + half + R"(, "up_deg": )" + half +
                   R"(, "edge_blend_deg": 0})";
    }
  }
  write_text(file, R"({"name": "small", "display_hz": 60, "viewports": [)" + viewports + "]}");
}

// `duration_s` of a person looking at the triangle, with a camera feed of grey pictures.
inline void write_small_session(const std::filesystem::path& folder, double duration_s) {
  SessionHeader header;
  header.name = "small";
  header.profile = xr1_half_profile();
  header.scene = "../scene/small.scene.json";
  header.pose_hz = 90;
  header.gaze_hz = 120;
  header.head_from_eye[0].position = {-0.03, 0, 0};
  header.head_from_eye[1].position = {0.03, 0, 0};
  header.cameras.resize(1);
  header.cameras[0].model = pinhole_camera(64, 48, 90);
  header.cameras[0].nominal_hz = 10;
  SessionRecorder recorder(folder);
  recorder.write_header(header);
  const auto stamp = [](double time_s) { return TimeNs{1'000'000'000} + static_cast<TimeNs>(time_s * 1e9); };
  Srgb8Image grey;
  grey.width_px = 64;
  grey.height_px = 48;
  grey.values.assign(3 * 64 * 48, 90);
  std::vector<std::uint8_t> png;
  encode_png(grey, png);
  for (int i = 0; 0.1 * i <= duration_s; ++i) {
    const std::string name = "00000" + std::to_string(i) + ".png";
    recorder.add_image(0, name, png);
    recorder.add_camera_frame(0, {stamp(0.1 * i), name});
  }
  for (double t = 0; t <= duration_s + 1e-9; t += 1.0 / 90) {
    Pose pose;
    pose.position = {0.1 * t, 1.0, 0.0};
    recorder.add_pose({stamp(t), pose});
  }
  const glm::dvec3 ahead{0, 0, -1};
  for (double t = 0; t <= duration_s; t += 1.0 / 120)
    recorder.add_gaze({stamp(t), {ahead, ahead}, {true, true}});
  recorder.finish();
}

}  // namespace herr
