// A walk of 1.6 s with five pictures, for tests of the feed that `herr convert` makes: three pictures within
// 66 ms, a pause of a second, two more. Before: a test writes stamps in some form. After: the session's rows,
// and the frames that replay shows of it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "server/output/png_encoder.h"
#include "tests/paths.h"
#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {

namespace fs = std::filesystem;

class ConvertFeedProgram : public ::testing::Test {
 protected:
  static constexpr std::int64_t kStartMs = 1'750'000'000'000;  // 2025-06-15 15:06:40 UTC
  static constexpr int kLengthMs = 1600;
  static constexpr double kMetresPerSecond = 0.5, kHalfIpd_m = 0.0315;
  const std::vector<int> kFiveMs{350, 383, 416, 1416, 1449};  // after the start

  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_profile(root() / "small.profile.json");
    write_walk("walk.txt", kStartMs);
  }
  const fs::path& root() const { return folder_.path(); }
  Outcome herr(const std::string& arguments) const { return run_program(root(), arguments); }

  // A head that moves to the right, 100 rows a second.
  void write_walk(const std::string& name, std::int64_t start_ms) const {
    std::string rows;
    for (int ms = 0; ms <= kLengthMs; ms += 10)
      rows +=
          seconds(start_ms + ms) + " " + std::to_string(kMetresPerSecond * 0.001 * ms) + " 1.6 0 0 0 0 1\n";
    folder_.write(name, rows);
  }
  static std::string seconds(std::int64_t ms) {
    const std::string sign = ms < 0 ? "-" : "", digits = std::to_string(1000 + std::abs(ms) % 1000);
    return sign + std::to_string(std::abs(ms) / 1000) + "." + digits.substr(1);
  }
  static std::string start_plus(int ms) { return std::to_string(kStartMs + ms); }

  // The bytes of the k-th picture: each of another grey.
  static std::string picture(int k, int width_px = 8, int height_px = 6) {
    Srgb8Image image;
    image.width_px = width_px;
    image.height_px = height_px;
    image.channels = 3;
    image.values.assign(static_cast<std::size_t>(3 * width_px * height_px),
                        static_cast<std::uint8_t>(40 * (k + 1)));
    std::vector<std::uint8_t> png;
    encode_png(image, png, 1);
    return {png.begin(), png.end()};
  }
  void write_pictures(const std::string& folder, const std::vector<std::string>& names) const {
    for (std::size_t k = 0; k < names.size(); ++k)
      folder_.write(folder + "/" + names[k], picture(static_cast<int>(k)));
  }
  // "a.png" ... "e.png": names that say no time.
  void write_nameless_pictures(const std::string& folder) const {
    write_pictures(folder, {"a.png", "b.png", "c.png", "d.png", "e.png"});
  }

  // What cam<i>/data.csv should hold for pictures at these milliseconds after `start_ms`.
  static std::string rows_at(const std::vector<int>& ms, std::int64_t start_ms = kStartMs) {
    std::string text = "timestamp_ns,filename\n";
    for (std::size_t k = 0; k < ms.size(); ++k)
      text += std::to_string((start_ms + ms[k]) * 1'000'000) + ",00000" + std::to_string(k) + ".png\n";
    return text;
  }
  // Five pictures in their order, each at its stamp.
  void expect_five(const std::string& session, std::size_t camera = 0) const {
    const fs::path cam = root() / session / ("cam" + std::to_string(camera));
    EXPECT_EQ(content_of(cam / "data.csv"), rows_at(kFiveMs));
    for (int k = 0; k < 5; ++k)
      EXPECT_EQ(content_of(cam / "data" / ("00000" + std::to_string(k) + ".png")), picture(k)) << k;
  }

  struct ShownFrame {
    std::int64_t t_ns = 0;
    std::optional<double> camera_age_ms, misregistration_arcmin;
  };
  std::vector<ShownFrame> replayed(const std::string& session, const std::string& flags = "") const {
    const Outcome got =
        herr("replay " + session +
             " --scene scene/small.scene.json --profile small.profile.json --preset direct --polar 32x16 "
             "--format none --contact-sheet none --overwrite --out out " +
             flags);
    EXPECT_EQ(got.exit_code, 0) << got.err;
    std::istringstream lines(content_of(root() / "out" / session / "frames.csv"));
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> names = fields(line);
    std::vector<ShownFrame> frames;
    while (std::getline(lines, line)) {
      const std::vector<std::string> values = fields(line);
      const auto value = [&](const char* name) -> std::optional<double> {
        const auto place = std::find(names.begin(), names.end(), name) - names.begin();
        const std::string& text = values.at(static_cast<std::size_t>(place));
        return text.empty() ? std::nullopt : std::optional<double>(std::stod(text));
      };
      frames.push_back({std::stoll(values.at(1)), value("camera_age_ms"), value("misregistration_arcmin")});
    }
    return frames;
  }

  // Every frame shows the newest picture taken before it. Until the first there is none. The head is that of
  // the newest pose, 10 ms apart; the camera was at the head's origin when it took the picture, and the worse
  // of the two eyes is half an eye distance further from there: under asin(way / distance) at most.
  void expect_shown_at(const std::vector<ShownFrame>& frames, const std::vector<int>& ms,
                       double distance_m = 2) const {
    ASSERT_EQ(frames.size(), 97u);  // 1.6 s at 60 Hz, both ends shown
    std::size_t changes = 0;
    std::optional<int> before;
    for (const ShownFrame& frame : frames) {
      const double at_ms = static_cast<double>(frame.t_ns - kStartMs * 1'000'000) * 1e-6;
      const auto next = std::find_if(ms.begin(), ms.end(), [&](int taken) { return taken > at_ms; });
      ASSERT_EQ(frame.camera_age_ms.has_value(), next != ms.begin()) << at_ms;
      if (next == ms.begin()) continue;
      const int taken = *std::prev(next);
      EXPECT_NEAR(*frame.camera_age_ms, at_ms - taken, 1e-5) << at_ms;
      const double pose_ms = 10 * std::floor(at_ms / 10 + 1e-9);
      const double way_m = std::abs(kMetresPerSecond * 0.001 * (pose_ms - taken)) + kHalfIpd_m;
      const double arcmin = std::asin(way_m / distance_m) * 60 * 180 / std::acos(-1.0);
      EXPECT_NEAR(*frame.misregistration_arcmin, arcmin, 1e-3) << at_ms;
      changes += taken != before;
      before = taken;
    }
    EXPECT_EQ(changes, ms.size()) << "a picture was never shown";
  }

  nlohmann::json session_json(const std::string& session) const {
    return nlohmann::json::parse(content_of(root() / session / "session.json"));
  }
  TemporaryFolder folder_;

 private:
  static std::vector<std::string> fields(const std::string& line) {
    std::vector<std::string> found(1);
    for (const char c : line)
      if (c == ',')
        found.emplace_back();
      else
        found.back() += c;
    return found;
  }
};

}  // namespace herr
