#include "tests/sessions/recorded_folder.h"

#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <glm/trigonometric.hpp>
#include <iomanip>
#include <sstream>

#include "sessions/files/input_error.h"
#include "tests/paths.h"

namespace herr::test {

RecordedFolder::RecordedFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "herr_test_XXXXXX").string();
  const char* made = ::mkdtemp(pattern.data());
  if (made == nullptr) throw std::runtime_error("no temporary folder");
  path_ = made;
}

RecordedFolder::~RecordedFolder() {
  std::error_code ignored;  // a test that left an unreadable folder has failed already
  std::filesystem::remove_all(path_, ignored);
}

void RecordedFolder::write(const std::string& name, std::string_view content) const {
  std::filesystem::create_directories((path_ / name).parent_path());
  std::ofstream file(path_ / name, std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) throw std::runtime_error("cannot write " + name);
}

void RecordedFolder::write_image(const std::string& name, int width_px, int height_px, double encoded) const {
  std::filesystem::create_directories((path_ / name).parent_path());
  const bool exr = std::filesystem::path(name).extension() == ".exr";
  OIIO::ImageSpec spec(width_px, height_px, 3, exr ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8);
  if (exr) spec.attribute("compression", std::string("zips"));
  const std::vector<float> samples(static_cast<std::size_t>(3 * width_px * height_px),
                                   static_cast<float>(encoded));
  const auto writer = OIIO::ImageOutput::create(name);
  if (!writer || !writer->open((path_ / name).string(), spec) ||
      !writer->write_image(OIIO::TypeDesc::FLOAT, samples.data()) || !writer->close())
    throw std::runtime_error("cannot write " + name);
}

std::string header_json(const std::string& fields, const std::string& gaze_kind) {
  return R"({"format_version": 1, "name": "test", "display_profile": "xr1", "gaze_kind": ")" + gaze_kind +
         "\"" + (fields.empty() ? "" : ", " + fields) + "}\n";
}

std::string cameras_json(int count, int width_px, int height_px) {
  std::ostringstream text;
  text << "\"cameras\": [";
  for (int i = 0; i < count; ++i)
    text << (i > 0 ? ", " : "") << R"({"model": "pinhole", "width_px": )" << width_px << R"(, "height_px": )"
         << height_px << R"(, "fx": 100, "fy": 100, "cx": 3, "cy": 2, "head_from_camera": {"position": [)"
         << 0.1 * (i + 1) << R"(, 0, 0], "orientation_xyzw": [0, 0, 0, 1]}})";
  text << "]";
  return text.str();
}

std::string pose_row(std::int64_t stamp_ns, double x, double y, double z) {
  std::ostringstream text;
  text << std::setprecision(17) << stamp_ns << ',' << x << ',' << y << ',' << z << ",0,0,0,1\n";
  return text.str();
}

std::string gaze_row(std::int64_t stamp_ns, double left_deg, bool left_valid, double right_deg,
                     bool right_valid) {
  std::ostringstream text;
  text << std::setprecision(17) << stamp_ns;
  const auto eye = [&](double angle_deg, bool valid) {
    const double angle = glm::radians(angle_deg);
    text << ',' << std::sin(angle) << ",0," << -std::cos(angle) << ',' << (valid ? 1 : 0);
  };
  eye(left_deg, left_valid);
  eye(right_deg, right_valid);
  text << '\n';
  return text.str();
}

void write_good_session(const RecordedFolder& folder) {
  std::string poses = kPoseHeader, gaze = kGazeHeader;
  for (int i = 0; i < 10; ++i) {
    poses += pose_row(i * 10'000'000LL, 0.01 * i);
    gaze += gaze_row(i * 10'000'000LL, 0, true, 0, true);
  }
  folder.write("session.json", header_json());
  folder.write("pose/data.csv", poses);
  folder.write("gaze/data.csv", gaze);
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::filesystem::path real_data() {
  const char* given = std::getenv("HERR_TEST_DATA");
  const std::filesystem::path folder =
      given != nullptr ? std::filesystem::path(given)
                       : std::filesystem::path(test::source_dir()).parent_path() / "shared" / "data";
  return std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}

}  // namespace herr::test
