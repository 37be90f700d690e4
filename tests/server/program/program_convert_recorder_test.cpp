// The folders that recorders leave: lenses and places of their cameras, pictures that are left out.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "sessions/session.h"
#include "tests/server/program/convert_feed_program.h"

namespace herr {
namespace {

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void expect_at(const glm::dvec3& got, const glm::dvec3& expected, double tolerance) {
  EXPECT_LT(glm::distance(got, expected), tolerance) << got.x << ", " << got.y << ", " << got.z;
}

// sensor.yaml of a camera of V1_01 of EuRoC (Burri et al., 2016), for pictures of 752 x 480.
std::string sensor_yaml(const std::string& t_bs, const std::string& intrinsics,
                        const std::string& distortion) {
  return "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [" + t_bs +
         ", 0.0, 0.0, 0.0, 1.0]\nrate_hz: 20\nresolution: [752, 480]\ncamera_model: pinhole\nintrinsics: [" +
         intrinsics + "]\ndistortion_model: radial-tangential\ndistortion_coefficients: [" + distortion +
         "]\n";
}

class EurocFolder : public ConvertFeedProgram {
 protected:
  void SetUp() override {
    ConvertFeedProgram::SetUp();
    // The body's x is up, y right, z forward, the world's z up: upright and looking along the world's y, the
    // columns of the rotation are up (0, 0, 1), right (1, 0, 0) and forward (0, 1, 0): q = (1, 1, 1, 1) / 2.
    std::string rows = "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], ...\n";
    for (int ms = 0; ms <= kLengthMs; ms += 10)
      rows += start_plus(ms) + "000000," + std::to_string(kMetresPerSecond * 0.001 * ms) +
              ",0,1.6,0.5,0.5,0.5,0.5,0,0,0,0,0,0,0,0,0\n";
    folder_.write("mav0/state_groundtruth_estimate0/data.csv", rows);
    const std::string yaml[2]{
        sensor_yaml("0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975, 0.999557249008, "
                    "0.0149672133247, 0.025715529948, -0.064676986768, -0.0257744366974, 0.00375618835797, "
                    "0.999660727178, 0.00981073058949",
                    "458.654, 457.296, 367.215, 248.375",
                    "-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05"),
        sensor_yaml("0.0125552670891, -0.999755099723, 0.0182237714554, -0.0198435579556, 0.999598781151, "
                    "0.0130119051815, 0.0251588363115, 0.0453689425024, -0.0253898008918, 0.0179005838253, "
                    "0.999517347078, 0.00786212447038",
                    "457.587, 456.134, 379.999, 255.238",
                    "-0.28368365, 0.07451284, -0.00010473, -3.55590700e-05")};
    for (int camera = 0; camera < 2; ++camera) {
      const std::string cam = "mav0/cam" + std::to_string(camera) + "/";
      std::string table = "#timestamp [ns],filename\n";
      for (int k = 0; k < 5; ++k) {
        const std::string stamp =
            start_plus(kFiveMs[static_cast<std::size_t>(k)]) + (camera == 0 ? "000000" : "000064");
        table += stamp + "," + stamp + ".png\r\n";
        folder_.write(cam + "data/" + stamp + ".png", picture(k, 752, 480));
      }
      folder_.write(cam + "data.csv", table);
      folder_.write(cam + "sensor.yaml", yaml[camera]);
    }
  }
};

// Columns of T_BS are the camera's right, down, forward and place in the body, of which x, y, z are our up,
// right and forward: a vector (x, y, z) of it is (y, x, -z) in ours.
TEST_F(EurocFolder, GivesBothCamerasTheirLensPlaceAndStampsInOneCommand) {
  const Outcome got = herr("convert mav0/.. s");
  ASSERT_EQ(got.exit_code, 0) << got.err << got.out;
  EXPECT_EQ(content_of(root() / "s/cam0/data.csv"), rows_at(kFiveMs));
  EXPECT_TRUE(says(content_of(root() / "s/cam1/data.csv"), start_plus(1449) + "000064,000004.png"));
  const Session session = Session::open(root() / "s");
  const auto& cameras = session.header().cameras;
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].model.fx, 458.654);
  EXPECT_EQ(cameras[0].model.distortion[1], 0.07395907);
  EXPECT_EQ(cameras[1].model.fy, 456.134);
  EXPECT_EQ(cameras[1].model.cx, 379.999);
  EXPECT_EQ(cameras[1].model.distortion[2], -0.00010473);
  EXPECT_EQ(cameras[1].nominal_hz, 20);
  const auto turned = [&](std::size_t i, const glm::dvec3& v) {
    return cameras[i].head_from_camera.orientation * v;
  };
  expect_at(turned(0, {0, 0, -1}), {0.025715529948, 0.00414029679422, -0.999660727178}, 1e-9);
  expect_at(turned(1, {0, 0, -1}), {0.0251588363115, 0.0182237714554, -0.999517347078}, 1e-9);
  expect_at(turned(1, {1, 0, 0}), {0.999598781151, 0.0125552670891, 0.0253898008918}, 1e-9);
  // 110 mm apart, the first to the left.
  expect_at(cameras[0].head_from_camera.position, {-0.064676986768, -0.0216401454975, -0.00981073058949},
            1e-12);
  expect_at(cameras[1].head_from_camera.position, {0.0453689425024, -0.0198435579556, -0.00786212447038},
            1e-12);
  EXPECT_TRUE(says(got.out, "level")) << got.out;
  EXPECT_EQ(herr("inspect s").exit_code, 0);
}

TEST_F(EurocFolder, LeavesItsPicturesOutOnRequestAndSaysWhyWhereItMust) {
  ASSERT_EQ(herr("convert . s --preset euroc --no-camera").exit_code, 0);
  EXPECT_FALSE(fs::exists(root() / "s/cam0"));
  EXPECT_TRUE(session_json("s")["cameras"].empty());
  fs::remove(root() / "mav0/cam1/sensor.yaml");
  const Outcome one = herr("convert . s --preset euroc --overwrite");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_TRUE(says(one.out,
                   "note: pictures were left out: ./mav0/cam1/data: has pictures of an unknown lens; "
                   "give --camera-hfov DEGREES or --camera-calibration FILE"))
      << one.out;
  EXPECT_EQ(session_json("s")["cameras"].size(), 1u);
  EXPECT_TRUE(says(session_json("s")["conversion"].dump(), "unknown lens"));
  const Outcome both = herr("convert . s --preset euroc --overwrite --camera-hfov 80");
  ASSERT_EQ(both.exit_code, 0) << both.err;
  EXPECT_EQ(session_json("s")["cameras"].size(), 2u);
}

// Stray Scanner writes the lens into each row; pictures carry the number of the frame.
TEST_F(ConvertFeedProgram, StrayScannerGivesStampsAndLensInItsOdometry) {
  std::string rows =
      "timestamp, frame, x, y, z, qx, qy, qz, qw, fx, fy, cx, cy, distortion_center_x, distortion_center_y\n";
  for (int i = 0; i < 50; ++i) {
    const std::string frame = std::to_string(1'000'000 + i).substr(1);
    rows += seconds(86'421'500 + 20 * i) + ", " + frame + ", " + std::to_string(0.002 * i) +
            ", 1.4, 0.2, 1, 0, 0, 0, 40.0, 41.0, 15.5, 11.5, , \n";
    if (i % 10 == 3) folder_.write("stray/rgb/" + frame + ".png", picture(i / 10, 32, 24));
  }
  folder_.write("stray/odometry.csv", rows);
  const Outcome got = herr("convert stray s");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  EXPECT_EQ(content_of(root() / "s/cam0/data.csv"), rows_at({60, 260, 460, 660, 860}, 86'421'500)) << got.out;
  const auto camera = session_json("s")["cameras"][0];
  EXPECT_EQ(camera["fx"], 40);
  EXPECT_EQ(camera["fy"], 41);
  EXPECT_EQ(camera["cx"], 15.5);
  EXPECT_EQ(camera["cy"], 11.5);
  const Session session = Session::open(root() / "s");
  const Pose& place = session.header().cameras[0].head_from_camera;
  expect_at(place.position, {0, 0, 0}, 1e-12);
  expect_at(place.orientation * glm::dvec3(0, 0, -1), {0, 0, -1}, 1e-12);
  expect_at(place.orientation * glm::dvec3(0, 1, 0), {0, 1, 0}, 1e-12);
}

// Rows of Frames.txt are stamp, number, fx, fy, cx, cy; VideoToPictures names pictures by nanoseconds.
TEST_F(ConvertFeedProgram, IosLoggerGivesTheLensInFramesTxt) {
  std::string poses, frames;
  for (int ms = 0; ms <= kLengthMs; ms += 20) poses += seconds(kStartMs + ms) + "000,0.1,0.2,0.3,1,0,0,0\r\n";
  for (int k = 0; k < 5; ++k) {
    const int ms = kFiveMs[static_cast<std::size_t>(k)];
    frames += seconds(kStartMs + ms) + "000," + std::to_string(k) + ",40.0,41.0,15.5,11.5\r\n";
    folder_.write("ios/cam0/" + start_plus(ms) + "000000.png", picture(k, 32, 24));
    folder_.write("counted/Frames/" + std::to_string(k + 8) + ".png", picture(k, 32, 24));
  }
  for (const std::string name : {"ios", "counted"}) {
    folder_.write(name + "/ARposes.txt", poses);
    folder_.write(name + "/Frames.txt", frames);
    const Outcome got = herr("convert " + name + " s --overwrite");
    ASSERT_EQ(got.exit_code, 0) << got.err;
    EXPECT_EQ(content_of(root() / "s/cam0/data.csv"), rows_at(kFiveMs)) << got.out;
    EXPECT_EQ(session_json("s")["cameras"][0]["fy"], 41);
  }
}

// The TUM RGB-D data set: rgb.txt names the pictures with their folder.
TEST_F(ConvertFeedProgram, TumRgbdFoldersBringTheirPictures) {
  fs::create_directories(root() / "tum");
  fs::copy_file(root() / "walk.txt", root() / "tum/groundtruth.txt");
  std::string table = "# color images\n# file: 'freiburg.bag'\n# timestamp filename\n";
  for (int k = 0; k < 5; ++k) {
    const std::string stamp = seconds(kStartMs + kFiveMs[static_cast<std::size_t>(k)]);
    table += stamp + "000 rgb/" + stamp + ".png\n";
    folder_.write("tum/rgb/" + stamp + ".png", picture(k));
  }
  folder_.write("tum/rgb.txt", table);
  const Outcome got = herr("convert tum s --camera-hfov 60");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  EXPECT_TRUE(says(got.out, "stamps: the table rgb.txt")) << got.out;
  expect_five("s");
}

// The head's own table is no table of stamps, though it lies where one could.
TEST_F(ConvertFeedProgram, TheRecordingItselfIsNotTakenForATableOfStamps) {
  std::string rows = "#timestamp, x, y, z, w, x, y, z\n";
  for (int ms = 0; ms <= kLengthMs; ms += 10) rows += start_plus(ms) + "000000,1,1.6,0,1,0,0,0\n";
  folder_.write("run/data.csv", rows);
  std::vector<std::string> names;
  for (const int ms : kFiveMs) names.push_back(start_plus(ms) + ".png");
  write_pictures("run/pictures", names);
  folder_.write("run/pictures2/1.png", picture(0));
  const std::string line =
      "convert run/data.csv s --preset euroc --variant y-up --camera-hfov 90 --camera run/";
  ASSERT_EQ(herr(line + "pictures").exit_code, 0);
  expect_five("s");
  EXPECT_EQ(herr(line + "pictures2 --overwrite").exit_code, 3);
}

}  // namespace
}  // namespace herr
