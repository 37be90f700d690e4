#include "server/study/export_sequences.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/output/float_exr.h"
#include "server/output/new_folder.h"
#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "server/process/version.h"
#include "server/results/summary_json.h"
#include "server/study/clip_flicker.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/write_error.h"

namespace herr {
namespace {

using SequenceJson = nlohmann::ordered_json;

constexpr int kExportPasses = 4;

std::string frame_name(std::size_t frame) {
  const std::string digits = std::to_string(frame);
  return "frame_" + std::string(4 - std::min<std::size_t>(4, digits.size()), '0') + digits + ".exr";
}

void write_picture(const std::filesystem::path& folder, std::size_t frame, const LinearPicture& picture) {
  if (const std::error_code failed = make_folders(folder)) throw WriteError(folder, "make", failed.value());
  FloatPlanes planes;
  planes.width_px = picture.width_px, planes.height_px = picture.height_px;
  planes.channels = {{"R", picture.plane[0]}, {"G", picture.plane[1]}, {"B", picture.plane[2]}};
  std::vector<std::uint8_t> bytes;
  encode_float_exr(planes, bytes);
  write_whole_file(folder / frame_name(frame), bytes);
}

// Where the gaze meets the viewport's plane, in pixels from the upper left corner; outside it as well.
SequenceJson gaze_json(const Viewport& v, const FrameSample& sample) {
  const auto eye = static_cast<std::size_t>(v.eye);
  const glm::dquat head_from_eye = sample.head_from_eye[eye].orientation;
  const glm::dvec3 gaze = glm::conjugate(head_from_eye) * sample.gaze.head_direction[eye];
  if (!(gaze.z < 0)) return nullptr;  // behind the plane
  const double x = (gaze.x / -gaze.z - v.tan_left) / (v.tan_right - v.tan_left) * v.width_px;
  const double y = (v.tan_up - gaze.y / -gaze.z) / (v.tan_up - v.tan_down) * v.height_px;
  return SequenceJson::array({x, y});
}

}  // namespace

void export_sequences(const StudyOptions& options, StudySubject& subject, StudyRun& run) {
  NewFolder folder({options.export_to, false, "--export", "sequences", {}});
  std::vector<StudySetting> settings;
  for (const StudySetting& setting : run.sweeps().settings) {
    if (setting.knob == "default") settings.push_back(setting);
  }
  const std::vector<Viewport>& viewports = subject.report().profile.viewports;
  SequenceJson json{{"format", "herr picture sequences"},
                    {"version", 1},
                    {"program", program_with_version()},
                    {"frames_per_second", subject.report().profile.display_hz},
                    {"values", "linear light, primaries of sRGB, white = 1"},
                    {"reference", "reference"},
                    {"tests", SequenceJson::array()},
                    {"viewports", SequenceJson::array()}};
  for (const StudySetting& setting : settings) {
    json["tests"].push_back(
        {{"folder", "light_samples_" + setting.base.substr(4)}, {"flags", flags_text(setting.changes)}});
  }
  for (const Viewport& v : viewports) {
    const double width_deg = (std::atan(v.tan_right) - std::atan(v.tan_left)) * 57.29577951308232;
    json["viewports"].push_back({{"name", v.name},
                                 {"width_px", v.width_px},
                                 {"height_px", v.height_px},
                                 {"pixels_per_degree", v.width_px / width_deg},
                                 {"gaze_px", SequenceJson::array()}});
  }
  References::Context context = run.reference_context();
  context.parallel_for = [](int count, const std::function<void(int)>& work) {
    for (int i = 0; i < count; ++i) work(i);
  };
  const KeepClipFrame keep = [&](std::size_t frame, const FrameInstant& instant,
                                 const std::vector<LinearPicture>& reference,
                                 const std::vector<std::vector<LinearPicture>>& pictures) {
    for (std::size_t v = 0; v < viewports.size(); ++v) {
      json["viewports"][v]["gaze_px"].push_back(gaze_json(viewports[v], *instant.sample));
      write_picture(folder.path() / "reference" / viewports[v].name, frame, reference[v]);
      for (std::size_t s = 0; s < settings.size(); ++s) {
        write_picture(folder.path() / json["tests"][s]["folder"].get<std::string>() / viewports[v].name,
                      frame, pictures[s][v]);
      }
    }
  };
  const std::vector<StudyRow> rows = measure_clip(
      subject, settings, context, kExportPasses, [](std::size_t) { return stop_signal() == 0; }, keep);
  if (rows.empty()) throw TemporaryError("--export: stopped by a signal; nothing was written");
  write_whole_file(folder.path() / "sequence.json", json_text(json));
  folder.keep();
}

}  // namespace herr
