// Everything that the headset would have known when a frame began: head, gaze, camera images.
// Before: Session::sample reads the streams. After: the renderer draws a frame of it.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "sessions/camera/camera_image.h"
#include "sessions/camera/camera_model.h"
#include "sessions/format/pose.h"

namespace herr {

// Gaze at a time: one unit direction per eye in head space (combined gaze is aimed at the vergence point).
struct SampledGaze {
  std::array<glm::dvec3, 2> head_direction{glm::dvec3{0, 0, -1}, glm::dvec3{0, 0, -1}};
  std::array<SampleSource, 2> source{SampleSource::centred, SampleSource::centred};
  TimeNs stamp_ns = 0;
  TimeNs age_ns = 0;  // of the newest row used; -1 when not meaningful
};

// A camera frame with the pose at which it was exposed.
struct SampledCamera {
  std::shared_ptr<const CameraImage> image;
  const CameraModel* model = nullptr;  // lives as long as the session
  Pose world_from_camera;              // at the frame's own stamp
  TimeNs stamp_ns = 0;
  TimeNs age_ns = 0;
};

// Everything that the headset would have known when a frame began at t_ns.
struct FrameSample {
  TimeNs t_ns = 0;
  TimeNs start_ns = 0;  // of the session: random numbers follow t_ns - start_ns
  SampledPose head;
  HeadSpeed head_speed;  // from poses recorded at or before t_ns, whatever the sampling mode
  SampledGaze gaze;
  std::array<Pose, 2> head_from_eye;
  std::array<std::optional<SampledCamera>, 2>
      cameras;  // per eye; both refer to the same frame when there is one camera
};

}  // namespace herr
