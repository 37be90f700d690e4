#include "server/bench/bench_command.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "renderer/bench_frame.h"
#include "scenes/load_scene.h"
#include "server/bench/bench_report.h"
#include "server/bench/frame_time_table.h"
#include "server/bench/left_out.h"
#include "server/bench/ray_limits.h"
#include "server/frames/warnings/picture_warnings.h"
#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/results/memory_parts.h"
#include "server/results/output_folder.h"
#include "server/results/summary_json.h"
#include "server/settings/option_checks.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr const char* kDefaultSession = "sessions/samples/desk-walk";

std::filesystem::path session_of(const BenchOptions& options) {
  if (!options.session.empty()) return options.session;
  if (!path_exists(kDefaultSession)) {
    throw UsageError(std::string("SESSION: missing, and there is no ") + kDefaultSession +
                     " here; name a session or run from the top folder of the source");
  }
  return kDefaultSession;
}

// What is measured, opened as `herr replay` opens it.
struct Subject {
  ReplayOptions options;
  SessionReport report;
  OpenedSession opened;
  std::optional<FrameStep> step;
  std::optional<SessionSequence> sequence;
  BenchSubject described;
};

void open(const BenchOptions& options, Subject& subject) {
  subject.options.sessions = {session_of(options)};
  subject.options.scene = options.scene;
  subject.options.asset_roots = options.asset_roots;
  subject.options.profile = options.profile;
  subject.options.profile_scale = options.profile_scale;
  subject.options.render = options.render;
  SessionReport& report = subject.report;
  report.session_folder = subject.options.sessions.front();
  report.name = session_folder_name(report.session_folder);
  open_session(subject.options, report, subject.opened);
  subject.step.emplace(subject.options, report, subject.opened);
  subject.sequence.emplace(*subject.step, spread_frames(report.range, options.frames));
  subject.described.session = report.header.name;
  subject.described.scene = report.scene_name;
  subject.described.cpu_name = cpu_name();
  subject.described.triangles = report.scene_triangles;
  subject.described.profile = report.profile;
  subject.described.profile_scale = options.profile_scale;
  subject.described.settings = report.settings;
  subject.described.session_has_camera = report.findings.camera_rows[0] > 0;
}

// What the measurement has taken of the machine, while its renderer stands.
void note_memory(std::int64_t picture_bytes, Subject& subject) {
  const PictureMemory pictures{picture_bytes, camera_bytes(subject.step->sample()), 0};
  subject.described.memory = memory_parts(*subject.opened.renderer, subject.opened.scene, pictures);
  subject.described.load = process_load();
}

// The whole sequence many times over: medians.
int measure_frames(const BenchOptions& options, Subject& subject) {
  Renderer& renderer = *subject.opened.renderer;
  const BenchResult result = bench_frames(renderer, *subject.sequence, options.repeats);
  note_memory(result.picture_bytes, subject);
  const BenchSubject& described = subject.described;
  print_result(options.json ? json_text(bench_json(result, described)) : bench_table(result, described));
  if (const std::string empty = nothing_measured_warning(static_cast<double>(result.counters.object_samples));
      !empty.empty())
    print_message("warning: " + empty);
  const std::string excess =
      rays_beyond_plan(result, result.plan, subject.opened.scene.lights.size(), renderer.settings());
  if (excess.empty()) return kExitDone;
  print_message(excess);
  return kExitInternal;
}

// Runs of the same length for each size of the polar buffer and each number of light samples: means.
int average_frames(const BenchOptions& options, Subject& subject) {
  std::vector<FrameTimeRow> rows = empty_table(options.render, options.polar_given);
  for (FrameTimeRow& row : rows) {
    for (std::size_t i = 0; i < kTableLightSamples.size(); ++i) {
      RenderSettings settings = options.render;
      settings.polar_width = row.polar_width;
      settings.polar_height = row.polar_height;
      settings.polar_acuity = row.acuity;
      settings.light_samples = kTableLightSamples[i];
      subject.step->rewind();  // a renderer is built on the scene as it was loaded
      build_renderer(settings, subject.report, subject.opened);
      subject.step->rewind();
      subject.described.settings = subject.opened.renderer->settings();
      row.cells[i] = bench_run(*subject.opened.renderer, *subject.sequence, options.seconds);
      note_memory(row.cells[i].picture_bytes, subject);
      row.memory_bytes[i] = total_bytes(subject.described.memory);
    }
  }
  const BenchSubject& described = subject.described;
  print_result(options.json ? json_text(frame_times_json(rows, described, options.seconds))
                            : frame_times_table(rows, described, options.seconds));
  return kExitDone;
}

// Each frame with and without what the frame plan leaves out.
int weigh_left_out(const BenchOptions& options, Subject& subject) {
  const LeftOutSubject what{subject.opened.scene, subject.report.profile, options.render,
                            subject.report.findings.camera_rows[0] > 0};
  const LeftOutResult result = measure_left_out(what, *subject.sequence, options.repeats);
  const BenchSubject& described = subject.described;
  print_result(options.json ? json_text(left_out_json(result, described))
                            : left_out_table(result, described));
  const std::string changed = changed_picture(result);
  if (changed.empty()) return kExitDone;
  print_message(changed);
  return kExitInternal;
}

}  // namespace

int run_bench(const BenchOptions& options) {
  end_at_once_on_signal();  // nothing is written, and half a measurement is none
  if (const int signal = stop_signal(); signal != 0) return kExitSignalBase + signal;
  check_render_settings(options.render);
  Subject subject;
  open(options, subject);
  if (options.left_out) return weigh_left_out(options, subject);
  return options.table ? average_frames(options, subject) : measure_frames(options, subject);
}

}  // namespace herr
