#include "sessions/import/presets/proven_angles.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <glm/geometric.hpp>
#include <string>

#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

// x left, y up, z forward, as Aria writes angles.
glm::dvec3 tangents_ray(double yaw, double pitch) {
  return glm::normalize(glm::dvec3(std::tan(yaw), std::tan(pitch), 1));
}
glm::dvec3 spherical_ray(double yaw, double pitch) {
  return {std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
}
std::array<double, 2> tangents_angles(const glm::dvec3& v) {
  return {std::atan(v.x / v.z), std::atan(v.y / v.z)};
}
std::array<double, 2> spherical_angles(const glm::dvec3& v) {
  return {std::atan2(v.x, v.z), std::asin(v.y / glm::length(v))};
}

class ProvenAngles : public ::testing::Test {
 protected:
  // Eyes at (yaw, pitch) = (0.02 + s, -0.36) and (0.14 + s, -0.36), and the combined ray that is their sum.
  template <typename Ray, typename Angles>
  void write_gaze(Ray ray, Angles angles, int decimals) {
    std::string text = "t,y,p,ly,lp,ry,rp\n";
    for (int i = 0; i < 20; ++i) {
      const double left = 0.02 + 0.001 * i, right = 0.14 + 0.001 * i;
      const std::array<double, 2> both = angles(ray(left, -0.36) + ray(right, -0.36));
      char line[160];
      std::snprintf(line, sizeof line, "%d,%.*f,%.*f,%.3f,-0.36,%.3f,-0.36\n", i, decimals, both[0], decimals,
                    both[1], left, right);
      text += line;
    }
    folder_.write("gaze.csv", text);
  }

  // The place in map_ of the alternative that is proven, or -1.
  long proven() const {
    std::vector<const GazeColumns*> fitting;
    for (const GazeColumns& gaze : map_.gaze) fitting.push_back(&gaze);
    const GazeColumns* found = proven_angles(folder_ / "gaze.csv", fitting);
    return found == nullptr ? -1 : found - map_.gaze.data();
  }

  static std::string alternatives(const std::string& convention) {
    const std::string end = "\"unit\": \"rad\", \"convention\": \"" + convention + "\"}";
    const std::string begin = R"({"time": {"column": "t", "unit": "s"}, "axes": ["left", "up", "forward"], )";
    return begin + R"("left": {"azimuth": "ly", "elevation": "lp", )" + end +
           R"(, "right": {"azimuth": "ry", "elevation": "rp", )" + end + "}, " + begin +
           R"("combined": {"azimuth": "y", "elevation": "p", )" + end + "}";
  }

  RecordedFolder folder_;
  ColumnMap map_ = parse_column_map(R"({"format_version": 1, "name": "lab", "gaze": [)" +
                                        alternatives("tangents") + ", " + alternatives("spherical") + "]}",
                                    "lab.json");
};

// At yaw 0.08 +- 0.06 and pitch -0.36 rad the wrong formula is off by about half a milliradian: the combined
// pitch of spherical rays is steeper by tan p (1 / cos 0.06 - 1) cos^2 p = 5.9e-4, that of tangents is not.
TEST_F(ProvenAngles, AreThoseWhoseEyesAddUpToTheCombinedRay) {
  write_gaze(spherical_ray, spherical_angles, 9);
  EXPECT_EQ(proven(), 2);
  write_gaze(tangents_ray, tangents_angles, 9);
  EXPECT_EQ(proven(), 0);
  write_gaze(spherical_ray, spherical_angles, 5);
  EXPECT_EQ(proven(), 2) << "rounded to 1e-5";
}

TEST_F(ProvenAngles, AreNotKnownWhereTheCombinedRayIsNoSum) {
  folder_.write("gaze.csv", "t,y,p,ly,lp,ry,rp\n0,0.08,-0.3,0.02,-0.25,0.14,-0.35\n");
  EXPECT_EQ(proven(), -1);
}

// Straight ahead both formulas agree.
TEST_F(ProvenAngles, AreNotKnownWhereFormulasAgree) {
  folder_.write("gaze.csv", "t,y,p,ly,lp,ry,rp\n0,0,0,-0.03,0,0.03,0\n");
  EXPECT_EQ(proven(), -1);
  folder_.write("gaze.csv", "t,y,p,ly,lp,ry,rp\n0,nan,0,-0.03,0,0.03,0\n");
  EXPECT_EQ(proven(), -1) << "no row with all rays";
}

// A row that is not whole and one without a number are the import's business.
TEST_F(ProvenAngles, PassBadRowsOver) {
  write_gaze(spherical_ray, spherical_angles, 9);
  std::ofstream(folder_ / "gaze.csv", std::ios::app) << "20,0.1\n21,lost,0,0.1,0,0.1,0\n";
  EXPECT_EQ(proven(), 2);
}

// The first two rows of a file that the services for Gen 2 glasses wrote (projectaria_tools,
// data/gen2/mps_sample): spherical.
TEST_F(ProvenAngles, OfGen2GlassesAreSpherical) {
  folder_.write("gaze.csv",
                "t,y,p,ly,ry,lp,rp\n"
                "1,0.07778378224032466,-0.36552523325782504,0.01876476162672043,0.13680238223075866,"
                "-0.3649531942118841,-0.36493456179992734\n"
                "2,0.07440283203563364,-0.367955632326911,0.015397038102149964,0.13340818977355956,"
                "-0.3673809867610174,-0.3673618000258642\n");
  EXPECT_EQ(proven(), 2);
}

}  // namespace
}  // namespace herr::test
