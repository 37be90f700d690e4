#include "server/convert/feed_sources.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "server/process/exit_code.h"

namespace herr {
namespace {

constexpr std::size_t kMostCameras = 2;

// The flag that speaks of pictures, the first in the order of the help; empty: none was given.
std::string flag_about_pictures(const FeedOptions& options) {
  const std::pair<bool, const char*> flags[]{{!options.stamps.empty(), "--camera-stamps"},
                                             {!options.names.empty(), "--camera-names"},
                                             {options.zone_minutes.has_value(), "--camera-zone"},
                                             {options.hz.has_value(), "--camera-hz"},
                                             {options.loop, "--camera-loop"},
                                             {options.offset_ms != 0, "--camera-offset-ms"},
                                             {options.hfov_deg != 0, "--camera-hfov"},
                                             {!options.calibration.empty(), "--camera-calibration"},
                                             {!options.label.empty(), "--camera-label"},
                                             {options.distance_m.has_value(), "--feed-distance"}};
  for (const auto& [given, name] : flags)
    if (given) return name;
  return {};
}

// One value for each camera, or one for all of them.
template <typename Value>
Value value_of(const std::vector<Value>& values, std::size_t camera) {
  return values.empty() ? Value{} : values[std::min(camera, values.size() - 1)];
}

void check_counts(const FeedOptions& options, std::size_t cameras) {
  const auto check = [&](std::size_t given, const std::string& flag) {
    if (given > cameras)
      throw UsageError(flag + ": is given " + std::to_string(given) + " times, and there " +
                       (cameras == 1 ? "is one camera" : "are " + std::to_string(cameras) + " cameras") +
                       "; give it once for each");
  };
  check(options.stamps.size(), "--camera-stamps");
  check(options.names.size(), "--camera-names");
  check(options.calibration.size(), "--camera-calibration");
  check(options.label.size(), "--camera-label");
  if (!options.label.empty() && options.label.size() < cameras)
    throw UsageError("--camera-label: is given once, and there are two cameras; give it once for each");
}

FeedSource source_of(const FeedOptions& options, const std::vector<FoundCamera>& found, std::size_t camera) {
  FeedSource source;
  source.of_folder = options.pictures.empty();
  if (source.of_folder) {
    const FoundCamera& one = found[camera];
    source = {one.pictures, one.stamps, one.calibration, "", one.names, true};
  } else {
    source.pictures = options.pictures[camera];
  }
  if (!options.stamps.empty()) {
    source.stamps = value_of(options.stamps, camera);
    source.names.clear();
  }
  if (!options.names.empty()) source.names = value_of(options.names, camera);
  if (!options.calibration.empty()) source.calibration = value_of(options.calibration, camera);
  source.label = value_of(options.label, camera);
  if (!source.label.empty() && source.calibration.empty())
    throw UsageError("--camera-label: names a camera of a calibration; give --camera-calibration FILE");
  return source;
}

}  // namespace

void check_feed_options(const FeedOptions& options) {
  if (options.pictures.size() > kMostCameras)
    throw UsageError("--camera: give one folder, or the left and the right eye's");
  if (options.none && !options.pictures.empty())
    throw UsageError("--no-camera: --camera is given too; give one of the two");
  if (const std::string flag = flag_about_pictures(options); options.none && !flag.empty())
    throw UsageError(flag + ": --no-camera leaves the pictures out; give one of the two");
  const int stamps =
      (options.hz ? 1 : 0) + (options.stamps.empty() ? 0 : 1) + (options.names.empty() ? 0 : 1);
  if (stamps > 1)
    throw UsageError("--camera-hz: give one of --camera-hz, --camera-stamps and --camera-names");
  if (options.hz && options.zone_minutes)
    throw UsageError("--camera-zone: with --camera-hz no dates are read; leave it out");
  if (options.hfov_deg != 0 && !options.calibration.empty())
    throw UsageError("--camera-hfov: the calibration has a lens of its own; give one of the two");
  if (options.hfov_deg != 0 && !options.label.empty())
    throw UsageError("--camera-label: names a camera of a calibration; give --camera-calibration FILE");
}

std::vector<FeedSource> feed_sources(const FeedOptions& options, const std::vector<FoundCamera>& found) {
  const std::size_t cameras = options.none               ? 0
                              : options.pictures.empty() ? std::min(found.size(), kMostCameras)
                                                         : options.pictures.size();
  if (const std::string flag = flag_about_pictures(options); cameras == 0 && !flag.empty())
    throw UsageError(flag + ": there are no pictures; give --camera DIR");
  if (options.loop && !options.hz)
    throw UsageError(
        "--camera-loop: pictures with stamps of their own cannot be looped; give --camera-hz with "
        "the rate at which they shall be shown, for example 30");
  if (cameras > 0) check_counts(options, cameras);
  std::vector<FeedSource> sources;
  for (std::size_t i = 0; i < cameras; ++i) sources.push_back(source_of(options, found, i));
  return sources;
}

}  // namespace herr
