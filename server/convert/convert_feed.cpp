#include "server/convert/convert_feed.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "server/convert/feed_table.h"
#include "sessions/camera/camera_model.h"
#include "sessions/files/input_error.h"
#include "sessions/import/cameras/camera_calibration.h"
#include "sessions/import/cameras/column_lens.h"
#include "sessions/import/cameras/exif_time.h"
#include "sessions/import/cameras/name_pattern.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

// Rates that session.json can state.
constexpr double kLowestPictureHz = 0.001, kHighestPictureHz = 10000;

// All that is known before the pictures are looked at.
struct FeedContext {
  const FeedOptions& options;
  const ColumnMap& map;
  const HeadColumns* head;  // null: not recorded
  const RecordingFiles& files;
};

// Pictures of other cameras may lie in the same folder: their names do not fit the pattern.
CameraPictures pictures_of(const FeedContext& context, const FeedSource& source) {
  if (source.names.empty()) return find_camera_pictures(source.pictures);
  const NamePattern pattern(source.names, source.pictures);
  return find_camera_pictures(source.pictures, [&](const std::string& stem) {
    return pattern.find(stem, context.options.zone_minutes).has_value();
  });
}

bool has_exif_time(const CameraPictures& pictures) {
  return std::any_of(pictures.files.begin(), pictures.files.end(),
                     [](const fs::path& file) { return read_exif_time(file).has_value(); });
}

[[noreturn]] void refuse_unstamped(const FeedSource& source, const std::vector<std::string>& passed_over) {
  std::string problem = "says nowhere when its pictures were taken";
  for (const std::string& table : passed_over) problem += " (" + table + ")";
  throw InputError(source.pictures, 0, problem,
                   "give --camera-stamps TABLE, or --camera-names PATTERN where their names say it, or "
                   "--camera-hz X where they follow each other evenly from the first pose on");
}

StampedPictures stamps_of_table(const FeedContext& context, const CameraPictures& pictures,
                                const CameraTable& table) {
  CameraColumns columns = table.format.columns;
  if (!columns.time.zone_minutes) columns.time.zone_minutes = context.options.zone_minutes;
  StampedPictures stamped = stamps_from_table(pictures, table.file, columns);
  if (!table.format.preset.empty()) stamped.source += ", read as one of " + table.format.preset;
  return stamped;
}

// From the names by the user's pattern, from the table, from the names, from EXIF.
StampedPictures stamps_of(const FeedContext& context, const FeedSource& source,
                          const CameraPictures& pictures, const std::optional<CameraTable>& table,
                          std::vector<std::string>& passed_over) {
  const std::optional<int> zone = context.options.zone_minutes;
  if (!source.names.empty()) return stamps_from_names(pictures, source.names, zone);
  if (table && table->named) return stamps_of_table(context, pictures, *table);
  if (table) {
    try {
      return stamps_of_table(context, pictures, *table);
    } catch (const InputError& error) {
      passed_over.push_back(printable(table->file.filename().string()) + " beside them " + error.problem());
    }
  }
  if (const auto pattern = stamp_pattern_of(pictures)) return stamps_from_names(pictures, *pattern, zone);
  if (has_exif_time(pictures)) return stamps_from_exif(pictures, zone);
  refuse_unstamped(source, passed_over);
}

// What the user's rate sets aside; empty: nothing.
std::string stamps_set_aside(const CameraPictures& pictures, const std::optional<CameraTable>& table) {
  if (table) return "the table " + printable(table->file.filename().string());
  if (stamp_pattern_of(pictures)) return "the names of the pictures";
  return has_exif_time(pictures) ? "EXIF" : "";
}

constexpr const char* kAheadOfTheHead = "the camera sits at the head's origin and looks straight ahead";

void set_lens(const FeedContext& context, const FeedSource& source, std::size_t index,
              const std::optional<CameraTable>& table, Feed& feed) {
  const ImageSize& size = feed.pictures.size;
  if (context.options.hfov_deg != 0) {
    feed.camera.model = pinhole_camera(size.width_px, size.height_px, context.options.hfov_deg);
    feed.assumed.emplace_back(kAheadOfTheHead);
    if (!source.calibration.empty())
      feed.remarks.push_back("--camera-hfov sets aside the lens and place of " +
                             printable(source.calibration.filename().string()));
  } else if (!source.calibration.empty()) {
    feed.camera = read_camera_calibration(source.calibration, {source.label, index}, size,
                                          context.head != nullptr ? *context.head : HeadColumns{});
  } else if (table && !table->format.columns.lens.empty()) {
    const ColumnLens lens = lens_from_columns(table->file, table->format.columns, size);
    feed.camera.model = lens.model;
    feed.assumed.emplace_back(kAheadOfTheHead);
    feed.assumed.insert(feed.assumed.end(), lens.remarks.begin(), lens.remarks.end());
  } else {
    throw InputError(source.pictures, 0, "has pictures of an unknown lens",
                     "give --camera-hfov DEGREES or --camera-calibration FILE");
  }
}

double median_hz(const std::vector<StampedPicture>& pictures) {
  std::vector<TimeNs> steps;
  for (std::size_t i = 1; i < pictures.size(); ++i)
    steps.push_back(pictures[i].stamp_ns - pictures[i - 1].stamp_ns);
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const double hz = 1e9 / static_cast<double>(*middle);
  return hz >= kLowestPictureHz && hz <= kHighestPictureHz ? hz : 0;
}

Feed open_feed(const FeedContext& context, const FeedSource& source, std::size_t index) {
  Feed feed;
  feed.folder = source.pictures;
  feed.pictures = pictures_of(context, source);
  std::vector<std::string> passed_over;
  const std::optional<CameraTable> table =
      find_camera_table(source, {context.map, context.files, !context.options.hz}, passed_over);
  if (!context.options.hz) {
    feed.stamped = stamps_of(context, source, feed.pictures, table, passed_over);
    for (const std::string& other : passed_over)
      feed.remarks.push_back("the stamps are those of " + feed.stamped->source + ": " + other);
  } else if (const std::string aside = stamps_set_aside(feed.pictures, table); !aside.empty()) {
    feed.remarks.push_back("--camera-hz sets aside the stamps of " + aside);
  }
  set_lens(context, source, index, table, feed);
  if (context.options.hz) feed.camera.nominal_hz = *context.options.hz;
  if (feed.camera.nominal_hz == 0) feed.camera.nominal_hz = median_hz(feed.stamped->pictures);
  return feed;
}

}  // namespace

std::vector<Feed> open_feeds(const FeedOptions& options, const std::vector<FeedSource>& sources,
                             const ChosenFormat& format, const RecordingFiles& files,
                             std::vector<std::string>& remarks) {
  const FeedContext context{options, *format.format.map, format.format.columns.head, files};
  std::vector<Feed> feeds;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    try {
      feeds.push_back(open_feed(context, sources[i], i));
    } catch (const InputError& error) {
      if (!sources[i].of_folder || context.options.any_stamps_or_lens()) throw;
      remarks.push_back("pictures were left out: " + std::string(error.what()));
    }
  }
  if (feeds.size() == 2 && !sources[0].calibration.empty() && options.hfov_deg == 0 &&
      feeds[0].camera.head_from_camera.position == feeds[1].camera.head_from_camera.position)
    throw InputError(sources[1].calibration, 0, "places both cameras at one point",
                     "give --camera-calibration once for each camera, or --camera-label");
  if (feeds.size() < sources.size() && !feeds.empty())
    remarks.push_back("the pictures of " + printable(feeds[0].folder.string()) + " are shown to both eyes");
  return feeds;
}

}  // namespace herr
