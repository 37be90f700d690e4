// Writes session folders for tests: a plain good one, of which a test changes what it is about.
// Every folder is removed at the end of its test.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace herr::test {

// A folder of its own below the system's folder for temporary files.
class RecordedFolder {
 public:
  RecordedFolder();
  ~RecordedFolder();
  RecordedFolder(const RecordedFolder&) = delete;
  RecordedFolder& operator=(const RecordedFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  // Writes a file, with its folders.
  void write(const std::string& name, std::string_view content) const;
  // A grey picture: 8-bit PNG, JPEG or half EXR by the extension of `name`.
  void write_image(const std::string& name, int width_px, int height_px, double encoded = 0.5) const;

 private:
  std::filesystem::path path_;
};

// session.json with `fields` ("\"key\": value, ...") after the required ones; "" for none.
std::string header_json(const std::string& fields = "", const std::string& gaze_kind = "per_eye");
// `"cameras": [...]` with `count` ideal pinholes of the given size.
std::string cameras_json(int count, int width_px, int height_px);

inline const std::string kPoseHeader = "timestamp_ns,px,py,pz,qx,qy,qz,qw\n";
inline const std::string kGazeHeader = "timestamp_ns,lx,ly,lz,l_valid,rx,ry,rz,r_valid\n";
inline const std::string kCameraHeader = "timestamp_ns,filename\n";

std::string pose_row(std::int64_t stamp_ns, double x, double y = 0, double z = 0);
// Both eyes look to the right by these angles, in the horizontal plane.
std::string gaze_row(std::int64_t stamp_ns, double left_deg, bool left_valid, double right_deg,
                     bool right_valid);

// A good session: header, ten poses 10 ms apart from 0 (x = 0.01 a row), and the same of gaze straight ahead.
void write_good_session(const RecordedFolder& folder);

// The message of the InputError that `action` throws, or "no error".
std::string error_of(const std::function<void()>& action);

// Real recordings beside the project, or an empty path where they are not at hand.
std::filesystem::path real_data();

}  // namespace herr::test

// Passes when `action` throws an InputError whose text holds `part`.
#define EXPECT_INPUT_ERROR(action, part) \
  EXPECT_PRED2(::herr::test::holds, ::herr::test::error_of([&] { action; }), part)

namespace herr::test {
inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
}  // namespace herr::test
