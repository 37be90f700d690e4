// Recordings of people as they move, made by formulas: the head turns and sways, the eyes rest on one thing
// after another of a room and jump between them, with a tracker's noise. And what recordings suffer on their
// way.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "sessions/inspect/findings.h"
#include "sessions/inspect/plausibility.h"
#include "sessions/streams/stream_rows.h"

namespace herr::test {

struct MadeRecording {
  std::vector<PoseRow> poses;  // 90 Hz
  std::vector<GazeRow> gaze;   // 120 Hz
  bool per_eye = true;
};
MadeRecording made_person(std::uint32_t seed, double seconds);

PlausibilityMeter measured(const MadeRecording& recording);
// "warning: PROBLEM" of each finding, a line each; only warnings where `notes` is false.
std::string judged(const MadeRecording& recording, bool notes = true);

// Reads the same numbers by other axes: rows of the matrix are the axes that the numbers are taken for.
void turn_world(MadeRecording& recording, const glm::dmat3& matrix);
void turn_head(MadeRecording& recording, const glm::dmat3& matrix);
void turn_gaze(MadeRecording& recording, const glm::dmat3& matrix);
glm::dmat3 rows(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z);

// Every third pose, held or joined by lines; `joined` lines hold position and orientation at constant speed.
void hold_every_third_pose(MadeRecording& recording);
void join_every_third_pose(MadeRecording& recording);
void smooth_gaze(MadeRecording& recording);  // a low-pass of first order at about 7 Hz

}  // namespace herr::test
