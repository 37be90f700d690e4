#include "server/convert/convert_command.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "server/convert/convert_report.h"
#include "server/output/new_session_folder.h"
#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/process/version.h"
#include "server/settings/flag_values.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/import/cameras/aria_calibration.h"
#include "sessions/import/presets/built_in_maps.h"
#include "sessions/import/cameras/camera_pictures.h"
#include "sessions/import/import_rows.h"
#include "sessions/record/session_recorder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMaxPictureBytes = std::int64_t{1} << 30;

const BuiltInMap& built_in(const std::string& name) {
  return built_in_maps().at(parse_word("--preset", name, built_in_map_names()));
}

ColumnMap chosen_map(const ConvertOptions& options) {
  if (!options.map.empty()) return read_column_map(options.map);
  return parse_column_map(built_in(options.preset).json, options.preset + ".json");
}

SessionHeader header_for(const ConvertOptions& options, const NewSessionFolder& folder, const ColumnMap& map,
                         DisplayProfile profile) {
  SessionHeader header = new_session_header(folder);
  header.provenance = std::string("converted by ") + program_with_version() + " from " +
                      printable(options.head.filename().string()) + " with the map " + printable(map.name);
  header.licence = options.licence;
  header.profile = std::move(profile);
  header.scene = options.scene;
  return header;
}

// Thrown where rows and pictures pass by once a signal has asked for the end.
struct Stopped {};

void stop_on_signal() {
  if (stop_signal() != 0) throw Stopped{};
}

struct Feed {
  CameraPictures pictures;
  SessionHeader::Camera camera;
};

Feed open_feed(const ConvertOptions& options, const ImportRequest& request) {
  Feed feed;
  feed.pictures = find_camera_pictures(options.camera);
  const ImageSize& size = feed.pictures.size;
  if (!options.camera_calibration.empty())
    feed.camera = read_aria_camera(options.camera_calibration, options.camera_label, size,
                                   fitting_head_columns(request));
  else
    feed.camera.model = pinhole_camera(size.width_px, size.height_px, options.camera_hfov_deg);
  feed.camera.nominal_hz = options.camera_hz;
  return feed;
}

// Every picture is copied once; a loop names them again.
std::int64_t write_feed(const ConvertOptions& options, const Feed& feed, const ImportedStream& poses,
                        SessionRecorder& recorder) {
  std::vector<std::string> names;
  std::int64_t rows = 0;
  for (;; ++rows) {
    stop_on_signal();
    const auto offset_ns =
        static_cast<TimeNs>(std::llround(static_cast<double>(rows) * 1e9 / options.camera_hz));
    const auto index = static_cast<std::size_t>(rows);
    if (poses.first_ns + offset_ns > poses.last_ns) break;
    if (!options.camera_loop && index >= feed.pictures.files.size()) break;
    if (index < feed.pictures.files.size()) {
      const fs::path& picture = feed.pictures.files[index];
      const std::string bytes = read_whole_file(picture, kMaxPictureBytes);
      names.push_back(numbered_picture(index, picture.extension().string()));
      recorder.add_image(0, names.back(),
                         {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    }
    recorder.add_camera_frame(0, {poses.first_ns + offset_ns, names[index % feed.pictures.files.size()]});
  }
  return rows;
}

// What replay would say of it; the result is a session or there is none.
SessionFindings check_result(const ConvertOptions& options, const NewSessionFolder& folder) {
  try {
    return folder.findings();
  } catch (const InputError& error) {
    throw InputError(options.head, 0, "gives no usable session: " + folder.with_final_name(error.what()),
                     "check the units and columns of the map");
  }
}

// A flag that would change nothing is a mistake of whoever gave it.
void check_camera_options(const ConvertOptions& options) {
  const ConvertOptions unset;
  const bool has_lens = options.camera_hfov_deg != 0, has_calibration = !options.camera_calibration.empty();
  if (options.camera.empty()) {
    for (const auto& [given, flag] :
         {std::pair{options.camera_hz != unset.camera_hz, "--camera-hz"},
          std::pair{options.camera_loop, "--camera-loop"}, std::pair{has_lens, "--camera-hfov"},
          std::pair{has_calibration, "--camera-calibration"},
          std::pair{options.camera_label != unset.camera_label, "--camera-label"}}) {
      if (given) throw UsageError(std::string(flag) + ": there are no pictures; give --camera DIR too");
    }
    return;
  }
  if (!has_lens && !has_calibration)
    throw UsageError(
        "--camera: the lens is unknown; give --camera-hfov DEGREES or --camera-calibration FILE");
  if (has_lens && has_calibration)
    throw UsageError("--camera-hfov: the calibration has a lens of its own; give one of the two");
  if (!has_calibration && options.camera_label != unset.camera_label)
    throw UsageError("--camera-label: names a camera of a calibration; give --camera-calibration FILE");
}

void check_options(const ConvertOptions& options) {
  check_camera_options(options);
  check_scene_name("--scene", options.scene);
  if (options.head == options.out) throw UsageError("OUT: is the recording itself; choose another folder");
}

int convert(const ConvertOptions& options) {
  const ColumnMap map = chosen_map(options);
  DisplayProfile profile = load_display_profile(options.profile);
  const ImportRequest request{options.head, options.gaze, &map, options.keep_going};
  ConvertReport report{options.out, map.name, {}, 0, 0, {}};
  Feed feed;
  if (!options.camera.empty()) feed = open_feed(options, request);

  NewSessionFolder folder(options.out, options.overwrite);
  SessionHeader header = header_for(options, folder, map, std::move(profile));
  SessionRecorder recorder(folder.path());
  report.rows = import_rows(request, {[&](const PoseRow& row) {
                                        stop_on_signal();
                                        recorder.add_pose(row);
                                      },
                                      [&](const GazeRow& row) {
                                        stop_on_signal();
                                        recorder.add_gaze(row);
                                      }});
  if (!options.camera.empty()) {
    header.cameras.push_back(feed.camera);
    report.camera_rows = write_feed(options, feed, report.rows.poses, recorder);
    report.pictures = std::min(report.camera_rows, static_cast<std::int64_t>(feed.pictures.files.size()));
  }
  header.gaze_combined = report.rows.gaze_combined || !report.rows.has_gaze;
  if (report.rows.gaze_combined) header.vergence_m = map.vergence_m;
  header.pose_hz = report.rows.poses.rate_hz();
  header.gaze_hz = report.rows.gaze.rate_hz();
  recorder.write_header(header);
  recorder.finish();
  report.findings = check_result(options, folder);
  stop_on_signal();
  folder.keep();
  print_result(options.json ? convert_json(report) : convert_text(report));
  return report.rows.poses.bad_rows + report.rows.gaze.bad_rows > 0 ? kExitPartial : kExitDone;
}

}  // namespace

int run_convert(const ConvertOptions& options) {
  if (options.show_map) {
    print_result(std::string(built_in(options.preset).json));
    return kExitDone;
  }
  check_options(options);
  try {
    return convert(options);
  } catch (const Stopped&) {
    print_message("stopped: nothing was written");
    return kExitSignalBase + stop_signal();
  }
}

}  // namespace herr
