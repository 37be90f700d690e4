#include "sessions/import/cameras/camera_calibration.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using test::RecordedFolder;

// sensor.yaml of cam0 of EuRoC V1_01 (Burri et al., 2016), whose body has x up, y right and z forward.
const std::string kEuroc = R"(# General sensor definitions.
sensor_type: camera
comment: VI-Sensor cam0 (MT9M034)

# Sensor extrinsics wrt. the body-frame.
T_BS:
  cols: 4
  rows: 4
  data: [0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975,
         0.999557249008, 0.0149672133247, 0.025715529948, -0.064676986768,
        -0.0257744366974, 0.00375618835797, 0.999660727178, 0.00981073058949,
         0.0, 0.0, 0.0, 1.0]

# Camera specific definitions.
rate_hz: 20
resolution: [752, 480]
camera_model: pinhole
intrinsics: [458.654, 457.296, 367.215, 248.375] #fu, fv, cu, cv
distortion_model: radial-tangential
distortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]
)";

// As TUM-VI's camchain.yaml, with a pose that can be seen through: camera x = body y + 0.1, y = -body x +
// 0.2, z = body z + 0.3.
const std::string kKalibr = R"(cam0:
  T_cam_imu:
  - [0.0, 1.0, 0.0, 0.1]
  - [-1.0, 0.0, 0.0, 0.2]
  - [0.0, 0.0, 1.0, 0.3]
  - [0.0, 0.0, 0.0, 1.0]
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [0.0034823894022493434, 0.0007150348452162257, -0.0020532361418706202, 0.00020293673591811182]
  distortion_model: equidistant
  intrinsics: [190.97847715128717, 190.9733070521226, 254.93170605935475, 256.8974428996504]
  resolution: [512, 512]
  rostopic: /cam0/image_raw
cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.1]
  - [0.0, 1.0, 0.0, 0.0]
  - [0.0, 0.0, 1.0, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  distortion_coeffs: [0.0, 0.0, 0.0, 0.0]
  distortion_model: radtan
  intrinsics: [190.0, 190.0, 254.0, 256.0]
  resolution: [512, 512]
)";

HeadColumns euroc_head() {
  HeadColumns head;
  head.head_axes = *AxisDirections::from_words({"up", "right", "forward"});
  return head;
}

SessionHeader::Camera read(const std::string& text, const ImageSize& size,
                           const CalibratedCamera& which = {}) {
  const RecordedFolder folder;
  folder.write("calibration", text);
  return read_camera_calibration(folder / "calibration", which, size, euroc_head());
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(CameraCalibration, EurocGivesLensAndPlace) {
  const SessionHeader::Camera camera = read(kEuroc, {752, 480});
  EXPECT_EQ(camera.model.kind, CameraModelKind::pinhole);
  EXPECT_EQ(camera.model.fx, 458.654);
  EXPECT_EQ(camera.model.cy, 248.375);
  EXPECT_EQ(camera.model.distortion[3], 1.76187114e-05);
  EXPECT_EQ(camera.nominal_hz, 20);
  EXPECT_GT(camera.model.max_angle_rad, 0.5);
  // Columns of T_BS are the camera's right, down and forward in the body; body x, y, z are our up, right,
  // forward.
  const glm::dvec3 forward = camera.head_from_camera.orientation * glm::dvec3(0, 0, -1);
  const glm::dvec3 up = camera.head_from_camera.orientation * glm::dvec3(0, 1, 0);
  EXPECT_LT(glm::distance(forward, glm::dvec3(0.025715529948, 0.00414029679422, -0.999660727178)), 1e-9);
  EXPECT_LT(glm::distance(up, glm::dvec3(-0.0149672133247, 0.999880929698, 0.00375618835797)), 1e-9);
  EXPECT_LT(glm::distance(camera.head_from_camera.position,
                          glm::dvec3(-0.064676986768, -0.0216401454975, -0.00981073058949)),
            1e-12);
}

TEST(CameraCalibration, KalibrGivesTheInverseOfItsPose) {
  const SessionHeader::Camera camera = read(kKalibr, {512, 512});
  EXPECT_EQ(camera.model.kind, CameraModelKind::kb4);
  EXPECT_EQ(camera.model.fy, 190.9733070521226);
  EXPECT_EQ(camera.model.distortion[2], -0.0020532361418706202);
  // The camera's origin is at body (0.2, -0.1, -0.3): 0.1 left, 0.2 up, 0.3 back; it looks straight ahead.
  EXPECT_LT(glm::distance(camera.head_from_camera.position, glm::dvec3(-0.1, 0.2, 0.3)), 1e-12);
  EXPECT_NEAR(std::abs(camera.head_from_camera.orientation.w), 1, 1e-12);
}

TEST(CameraCalibration, AFifthCoefficientIsK3AndNoneIsAnIdealPinhole) {
  EXPECT_EQ(read(with(kEuroc, "1.76187114e-05]", "1.76187114e-05, 0.25]"), {752, 480}).model.distortion[4],
            0.25);
  EXPECT_EQ(read(with(kEuroc, "radial-tangential", "none"), {752, 480}).model.distortion[0], 0);
}

TEST(CameraCalibration, ACameraIsChosenByLabelOrPlace) {
  EXPECT_EQ(read(kKalibr, {512, 512}, {"cam0", 1}).model.cx, 254.93170605935475);
  EXPECT_INPUT_ERROR(read(kKalibr, {512, 512}, {"", 1}), "cam1.T_cam_imu");
  EXPECT_INPUT_ERROR(read(kKalibr, {512, 512}, {"cam2", 0}),
                     "has no camera 'cam2'; give --camera-label with one of: cam0, cam1");
  EXPECT_INPUT_ERROR(read(kEuroc, {752, 480}, {"cam0", 0}), "describes one camera; leave --camera-label out");
}

TEST(CameraCalibration, WhatDoesNotFitIsRefusedByName) {
  EXPECT_INPUT_ERROR(read(kEuroc, {376, 240}), "resolution is 752x480, and the pictures are 376x240");
  EXPECT_INPUT_ERROR(read(with(kEuroc, "radial-tangential", "fov"), {752, 480}), "distortion_model is 'fov'");
  EXPECT_INPUT_ERROR(read(with(kEuroc, "camera_model: pinhole", "camera_model: omni"), {752, 480}),
                     "camera_model is 'omni'");
  EXPECT_INPUT_ERROR(read(with(kEuroc, "0.999557249008", "0.5"), {752, 480}),
                     "T_BS is no rotation and translation");
  EXPECT_INPUT_ERROR(read(with(kEuroc, "458.654, ", ""), {752, 480}), "intrinsics has 3 elements");
  EXPECT_INPUT_ERROR(read(with(kKalibr, "[0.0, 1.0, 0.0, 0.1]", "[0.0, 1.0, 0.1]"), {512, 512}),
                     "cam0.T_cam_imu is no matrix of 4 rows of 4 numbers");
}

TEST(CameraCalibration, OtherFilesAreToldWhichKindsThereAre) {
  EXPECT_INPUT_ERROR(read("a: 1\n", {4, 3}),
                     "is no calibration of a known kind; known are Project Aria's JSON");
  EXPECT_INPUT_ERROR(read("{\"a\": 1}", {4, 3}), "lists no cameras (CameraCalibrations)");
  EXPECT_INPUT_ERROR(read("", {4, 3}), "calibration");
  EXPECT_INPUT_ERROR(read("a: [1, 2\nb: 3\n", {4, 3}), "is no YAML");
  EXPECT_INPUT_ERROR(read("x: 1\na: \"1\n", {4, 3}), "calibration:");
  EXPECT_INPUT_ERROR(read("a: 1\na: 2\n", {4, 3}), "calibration:2: names 'a' twice");
}

TEST(CameraCalibration, GenTwoOfAriaIsNamed) {
  EXPECT_INPUT_ERROR(read(R"({"CameraCalibrations": [{"Label": "slam-front-left"}]})", {4, 3}),
                     "is a calibration of Aria Gen 2 glasses (camera 'slam-front-left')");
  EXPECT_INPUT_ERROR(read(R"({"CameraCalibrations": [{"Label": "camera-slam-left"}]})", {4, 3}, {"", 1}),
                     "which of its cameras the second feed is; give --camera-label");
}

// Nine levels of nine aliases each would stand for 9^9 values.
TEST(CameraCalibration, AliasesAndDeepNestingAreRefusedAtOnce) {
  std::string bomb = "a: &a [x, x, x, x, x, x, x, x, x]\n";
  for (char c = 'b'; c <= 'i'; ++c) {
    const std::string before = std::string("*") + static_cast<char>(c - 1);
    bomb += std::string(1, c) + ": &" + c + " [" + before;
    for (int i = 1; i < 9; ++i) bomb += ", " + before;
    bomb += "]\n";
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_INPUT_ERROR(read(bomb, {4, 3}), "calibration:1: holds an anchor or alias");
  EXPECT_INPUT_ERROR(read("a: " + std::string(100000, '['), {4, 3}), "nested deeper than 16");
  std::string many = "a: [0";
  for (int i = 0; i < 30000; ++i) many += ", 0";
  EXPECT_INPUT_ERROR(read(many + "]\n", {4, 3}), "more than 20000 values");
  EXPECT_INPUT_ERROR(read(std::string(300 << 10, '#'), {4, 3}), "calibration");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

}  // namespace
}  // namespace herr
