#include "server/convert/convert_feed.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "server/output/new_session_folder.h"
#include "server/process/exit_code.h"
#include "server/text/number_text.h"
#include "sessions/camera/camera_model.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/import/cameras/camera_calibration.h"
#include "sessions/import/cameras/column_lens.h"
#include "sessions/import/cameras/exif_time.h"
#include "sessions/import/cameras/name_pattern.h"
#include "sessions/import/presets/camera_table.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMaxPictureBytes = std::int64_t{1} << 30;

// One camera as the user and the recorder's folder describe it together.
struct FeedSource {
  fs::path pictures, stamps, calibration;
  std::string label, names;
  bool of_folder = false;  // found, not named by the user
};

template <typename Value>
Value one_of(const std::vector<Value>& values, std::size_t camera) {
  if (values.empty()) return {};
  return values[std::min(camera, values.size() - 1)];
}

std::vector<FeedSource> sources_of(const FeedOptions& options, const std::vector<FoundCamera>& found) {
  std::vector<FeedSource> sources;
  if (options.none) return sources;
  const std::size_t count =
      options.pictures.empty() ? std::min<std::size_t>(found.size(), 2) : options.pictures.size();
  for (std::size_t i = 0; i < count; ++i) {
    FeedSource source;
    source.of_folder = options.pictures.empty();
    if (source.of_folder)
      source = {found[i].pictures, found[i].stamps, found[i].calibration, "", found[i].names, true};
    else
      source.pictures = options.pictures[i];
    if (!options.stamps.empty()) source.stamps = one_of(options.stamps, i);
    if (!options.calibration.empty()) source.calibration = one_of(options.calibration, i);
    if (options.hfov_deg != 0) source.calibration.clear();
    source.label = one_of(options.label, i);
    if (!options.names.empty()) source.names = options.names;
    if (!options.names.empty() || options.hz) source.stamps.clear();
    sources.push_back(std::move(source));
  }
  return sources;
}

// The table that programs put beside a camera's folder of pictures.
fs::path table_beside(const fs::path& pictures) {
  const fs::path folder = pictures.has_filename() ? pictures : pictures.parent_path();
  for (const fs::path& table : {folder / "data.csv", folder / "frames.csv", folder.parent_path() / "data.csv",
                                folder.parent_path() / "frames.csv"})
    if (path_exists(table)) return table;
  return {};
}

// From the table, from names, from EXIF; nothing where the user gives a rate.
std::optional<StampedPictures> stamps_of(const FeedOptions& options, const FeedSource& source,
                                         const CameraPictures& pictures, const ChosenFormat& format) {
  if (options.hz) return std::nullopt;
  if (!source.names.empty()) return stamps_from_names(pictures, source.names, options.zone_minutes);
  const fs::path table = source.stamps.empty() ? table_beside(source.pictures) : source.stamps;
  if (!table.empty()) return stamps_from_table(pictures, table, camera_columns_of(table, *format.format.map));
  if (const auto pattern = stamp_pattern_of(pictures))
    return stamps_from_names(pictures, *pattern, options.zone_minutes);
  if (read_exif_time(pictures.files.front())) return stamps_from_exif(pictures, options.zone_minutes);
  throw InputError(
      source.pictures, 0, "says nowhere when its pictures were taken",
      "give --camera-stamps TABLE, --camera-names PATTERN, or --camera-hz X where they follow each other "
      "evenly from the first pose on");
}

// Pictures of other cameras may lie in the same folder: their names do not fit the pattern.
CameraPictures pictures_of(const FeedOptions& options, const FeedSource& source) {
  if (source.names.empty()) return find_camera_pictures(source.pictures);
  const NamePattern pattern(source.names, source.pictures);
  return find_camera_pictures(source.pictures, [&](const std::string& stem) {
    return pattern.find(stem, options.zone_minutes).has_value();
  });
}

void set_lens(const FeedOptions& options, const FeedSource& source, std::size_t index,
              const ChosenFormat& format, Feed& feed) {
  const ImageSize& size = feed.pictures.size;
  if (options.hfov_deg != 0) {
    feed.camera.model = pinhole_camera(size.width_px, size.height_px, options.hfov_deg);
    return;
  }
  if (!source.calibration.empty()) {
    const HeadColumns* head = format.format.columns.head;
    feed.camera = read_camera_calibration(source.calibration, {source.label, index}, size,
                                          head != nullptr ? *head : HeadColumns{});
    return;
  }
  const fs::path table = source.stamps.empty() ? table_beside(source.pictures) : source.stamps;
  if (!table.empty()) {
    const CameraColumns columns = camera_columns_of(table, *format.format.map);
    if (!columns.lens.empty()) {
      const ColumnLens lens = lens_from_columns(table, columns, size);
      feed.camera.model = lens.model;
      feed.remarks = lens.remarks;
      return;
    }
  }
  throw InputError(source.pictures, 0, "has pictures of an unknown lens",
                   "give --camera-hfov DEGREES or --camera-calibration FILE");
}

Feed open_feed(const FeedOptions& options, const FeedSource& source, std::size_t index,
               const ChosenFormat& format) {
  Feed feed;
  feed.pictures = pictures_of(options, source);
  feed.stamped = stamps_of(options, source, feed.pictures, format);
  set_lens(options, source, index, format, feed);
  if (options.hz) feed.camera.nominal_hz = *options.hz;
  return feed;
}

double median_hz(const std::vector<StampedPicture>& pictures) {
  std::vector<TimeNs> steps;
  for (std::size_t i = 1; i < pictures.size(); ++i)
    steps.push_back(pictures[i].stamp_ns - pictures[i - 1].stamp_ns);
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return 1e9 / static_cast<double>(*middle);
}

void add_picture(SessionRecorder& recorder, std::size_t camera, const std::string& name,
                 const fs::path& picture) {
  const std::string bytes = read_whole_file(picture, kMaxPictureBytes);
  recorder.add_image(camera, name, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

FeedReport write_stamped(std::size_t camera, const StampedPictures& stamped, TimeNs shift_ns,
                         SessionRecorder& recorder, void (*pass_by)()) {
  FeedReport report;
  report.stamps = stamped.source;
  report.left_out = stamped.without_stamp + stamped.repeated_stamps;
  report.remarks = stamped.remarks;
  for (const StampedPicture& picture : stamped.pictures) {
    pass_by();
    const TimeNs stamp_ns = picture.stamp_ns + shift_ns;
    if (stamp_ns < 0 || stamp_ns > kLastStampNs)
      throw InputError(picture.file, 0, "has a stamp that is not of the recording's clock",
                       "give --camera-offset-ms, or check the unit of the stamps");
    const std::string name =
        numbered_picture(static_cast<std::size_t>(report.frames), picture.file.extension().string());
    add_picture(recorder, camera, name, picture.file);
    recorder.add_camera_frame(camera, {stamp_ns, name});
    ++report.frames;
  }
  report.pictures = report.frames;
  return report;
}

FeedReport write_at_rate(const FeedOptions& options, std::size_t camera, const CameraPictures& pictures,
                         const ImportedStream& poses, SessionRecorder& recorder, void (*pass_by)()) {
  FeedReport report;
  report.stamps = "assumed: " + shortest_text(*options.hz) + " pictures a second from the first pose on";
  std::vector<std::string> names;
  for (;; ++report.frames) {
    pass_by();
    const auto offset_ns =
        static_cast<TimeNs>(std::llround(static_cast<double>(report.frames) * 1e9 / *options.hz));
    const auto index = static_cast<std::size_t>(report.frames);
    if (poses.first_ns + offset_ns > poses.last_ns) break;
    if (!options.loop && index >= pictures.files.size()) break;
    if (index < pictures.files.size()) {
      names.push_back(numbered_picture(index, pictures.files[index].extension().string()));
      add_picture(recorder, camera, names.back(), pictures.files[index]);
    }
    recorder.add_camera_frame(camera, {poses.first_ns + offset_ns, names[index % pictures.files.size()]});
  }
  report.pictures = static_cast<std::int64_t>(names.size());
  return report;
}

}  // namespace

void check_feed_options(const FeedOptions& options) {
  const auto refuse_count = [&](std::size_t given, const std::string& flag) {
    if (!options.pictures.empty() && given > options.pictures.size())
      throw UsageError(flag + ": is given more often than --camera");
  };
  if (options.pictures.size() > 2)
    throw UsageError("--camera: give one folder, or the left and the right eye's");
  refuse_count(options.stamps.size(), "--camera-stamps");
  refuse_count(options.calibration.size(), "--camera-calibration");
  refuse_count(options.label.size(), "--camera-label");
  if (!options.stamps.empty() && options.stamps.size() < options.pictures.size())
    throw UsageError("--camera-stamps: give one table for each --camera");
  const int stamp_flags =
      (options.hz ? 1 : 0) + (options.stamps.empty() ? 0 : 1) + (options.names.empty() ? 0 : 1);
  if (stamp_flags > 1)
    throw UsageError("--camera-hz: give one of --camera-hz, --camera-stamps and --camera-names");
  if (options.loop && !options.hz)
    throw UsageError("--camera-loop: pictures with stamps of their own cannot be looped; give --camera-hz");
  if (options.hfov_deg != 0 && !options.calibration.empty())
    throw UsageError("--camera-hfov: the calibration has a lens of its own; give one of the two");
  if (options.hfov_deg != 0 && !options.label.empty())
    throw UsageError("--camera-label: names a camera of a calibration; give --camera-calibration FILE");
  if (options.none && !options.pictures.empty())
    throw UsageError("--no-camera: --camera is given too; give one of the two");
}

std::vector<Feed> open_feeds(const FeedOptions& options, const std::vector<FoundCamera>& found,
                             const ChosenFormat& format, std::vector<std::string>& remarks) {
  std::vector<Feed> feeds;
  std::size_t index = 0;
  for (const FeedSource& source : sources_of(options, found)) {
    try {
      Feed feed = open_feed(options, source, index++, format);
      if (feed.stamped) {
        if (feed.camera.nominal_hz == 0) feed.camera.nominal_hz = median_hz(feed.stamped->pictures);
        const auto offset_ns = static_cast<TimeNs>(std::llround(options.offset_ms * 1e6));
        for (StampedPicture& picture : feed.stamped->pictures) picture.stamp_ns += offset_ns;
      }
      feeds.push_back(std::move(feed));
    } catch (const InputError& error) {
      if (!source.of_folder) throw;
      remarks.push_back("pictures were left out: " + std::string(error.what()));
    }
  }
  return feeds;
}

FeedReport write_feed(const FeedOptions& options, std::size_t camera, const Feed& feed,
                      const ImportReport& rows, SessionRecorder& recorder, void (*pass_by)()) {
  FeedReport report = feed.stamped
                          ? write_stamped(camera, *feed.stamped, rows.shift_ns, recorder, pass_by)
                          : write_at_rate(options, camera, feed.pictures, rows.poses, recorder, pass_by);
  report.remarks.insert(report.remarks.end(), feed.remarks.begin(), feed.remarks.end());
  return report;
}

}  // namespace herr
