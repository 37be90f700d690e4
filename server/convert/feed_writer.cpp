#include "server/convert/feed_writer.h"

#include <cmath>

#include "server/output/new_session_folder.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"

namespace herr {
namespace {

constexpr std::int64_t kMaxPictureBytes = std::int64_t{1} << 30;

void add_picture(SessionRecorder& recorder, std::size_t camera, const std::string& name,
                 const std::filesystem::path& picture) {
  const std::string bytes = read_whole_file(picture, kMaxPictureBytes);
  recorder.add_image(camera, name, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

TimeNs offset_ns_of(const FeedOptions& options) {
  return static_cast<TimeNs>(std::llround(options.offset_ms * 1e6));
}

std::string seconds_text(TimeNs from_ns, TimeNs to_ns) {
  return fixed_text((static_cast<double>(to_ns) - static_cast<double>(from_ns)) * kSecondsPerNs, 3);
}

// Of a recording's length; a picture is shown until the next one comes.
bool outside(TimeNs stamp_ns, const ImportedStream& poses) {
  return stamp_ns < poses.first_ns || stamp_ns > poses.last_ns;
}

// `move_ns`: what is added to every stamp of a picture.
void check_span(const Feed& feed, const ImportedStream& poses, TimeNs move_ns, FeedReport& report) {
  const std::vector<StampedPicture>& pictures = feed.stamped->pictures;
  std::int64_t strays = 0;
  for (const StampedPicture& picture : pictures) strays += outside(picture.stamp_ns + move_ns, poses);
  if (strays == 0) return;
  const auto all = static_cast<std::int64_t>(pictures.size());
  const TimeNs first_ns = pictures.front().stamp_ns + move_ns, last_ns = pictures.back().stamp_ns + move_ns;
  if (strays == all && (last_ns < poses.first_ns || first_ns > poses.last_ns)) {
    const bool early = last_ns < poses.first_ns;
    throw InputError(feed.folder, 0,
                     "has no picture of the time in which the head was recorded: " +
                         (early ? "the last was taken " + seconds_text(last_ns, poses.first_ns) +
                                      " s before the first pose"
                                : "the first was taken " + seconds_text(poses.last_ns, first_ns) +
                                      " s after the last pose") +
                         " (stamps of " + feed.stamped->source + ")",
                     "check the unit, the clock and the zone of these stamps, or give --camera-offset-ms");
  }
  report.remarks.push_back(std::to_string(strays) + " of " + std::to_string(all) +
                           " pictures were taken before the first pose or after the last one: from " +
                           seconds_text(poses.first_ns, first_ns) + " s to " +
                           seconds_text(poses.first_ns, last_ns) +
                           " s after the first pose, the last of which is at " +
                           seconds_text(poses.first_ns, poses.last_ns) + " s");
}

void write_stamped(const FeedOptions& options, std::size_t camera, const Feed& feed, const ImportReport& rows,
                   SessionRecorder& recorder, void (*pass_by)(), FeedReport& report) {
  const StampedPictures& stamped = *feed.stamped;
  const TimeNs move_ns = rows.shift_ns + offset_ns_of(options);
  report.stamps = stamped.source;
  report.without_stamp = stamped.without_stamp;
  report.repeated_stamps = stamped.repeated_stamps;
  report.assumed = stamped.assumed;
  report.remarks = stamped.remarks;
  if (options.offset_ms != 0)
    report.assumed.push_back("stamps were moved by " + shortest_text(options.offset_ms) + " ms");
  check_span(feed, rows.poses, move_ns, report);
  for (const StampedPicture& picture : stamped.pictures) {
    pass_by();
    const TimeNs stamp_ns = picture.stamp_ns + move_ns;
    if (stamp_ns < 0) {
      ++report.before_zero;
      continue;
    }
    if (stamp_ns > kLastStampNs)
      throw InputError(picture.file, 0, "has a stamp more than 126 years after zero",
                       "check the unit of the stamps, or give --camera-offset-ms");
    const std::string name =
        numbered_picture(static_cast<std::size_t>(report.frames), picture.file.extension().string());
    add_picture(recorder, camera, name, picture.file);
    recorder.add_camera_frame(camera, {stamp_ns, name});
    ++report.frames;
  }
  report.pictures = report.frames;
  if (report.before_zero > 0)
    report.remarks.push_back(std::to_string(report.before_zero) +
                             " pictures have negative stamps, before the first pose, and are left out");
}

void write_at_rate(const FeedOptions& options, std::size_t camera, const Feed& feed,
                   const ImportedStream& poses, SessionRecorder& recorder, void (*pass_by)(),
                   FeedReport& report) {
  const std::vector<std::filesystem::path>& files = feed.pictures.files;
  std::string pace = shortest_text(*options.hz) + " pictures a second from the first pose on";
  if (options.offset_ms != 0) pace += ", moved by " + shortest_text(options.offset_ms) + " ms";
  report.stamps = "assumed: " + pace;
  report.assumed.push_back("stamps of pictures, which were not recorded: " + pace);
  const TimeNs start_ns = poses.first_ns + offset_ns_of(options);
  if (start_ns < 0 || start_ns > poses.last_ns)
    throw InputError(feed.folder, 0,
                     "would be shown from " + seconds_text(poses.first_ns, start_ns) +
                         " s after the first pose on, which no recording of " +
                         seconds_text(poses.first_ns, poses.last_ns) + " s has",
                     "check --camera-offset-ms");
  std::vector<std::string> names;
  for (std::size_t i = 0; options.loop || i < files.size(); ++i) {
    pass_by();
    const TimeNs stamp_ns =
        start_ns + static_cast<TimeNs>(std::llround(static_cast<double>(i) * 1e9 / *options.hz));
    if (stamp_ns > poses.last_ns) break;
    if (i < files.size()) {
      names.push_back(numbered_picture(i, files[i].extension().string()));
      add_picture(recorder, camera, names.back(), files[i]);
    }
    recorder.add_camera_frame(camera, {stamp_ns, names[i % files.size()]});
    ++report.frames;
  }
  report.pictures = static_cast<std::int64_t>(names.size());
  if (const std::size_t unused = files.size() - names.size(); unused > 0)
    report.remarks.push_back("the last " + std::to_string(unused) + " of " + std::to_string(files.size()) +
                             " pictures are not used: the poses end before them");
}

}  // namespace

FeedReport write_feed(const FeedOptions& options, std::size_t camera, const Feed& feed,
                      const ImportReport& rows, SessionRecorder& recorder, void (*pass_by)()) {
  FeedReport report;
  report.folder = feed.folder;
  if (feed.stamped)
    write_stamped(options, camera, feed, rows, recorder, pass_by, report);
  else
    write_at_rate(options, camera, feed, rows.poses, recorder, pass_by, report);
  report.assumed.insert(report.assumed.end(), feed.assumed.begin(), feed.assumed.end());
  report.remarks.insert(report.remarks.end(), feed.remarks.begin(), feed.remarks.end());
  return report;
}

}  // namespace herr
