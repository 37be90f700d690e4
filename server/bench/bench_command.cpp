#include "server/bench/bench_command.h"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/bench_frame.h"
#include "scenes/load_scene.h"
#include "server/bench/bench_report.h"
#include "server/bench/frame_time_table.h"
#include "server/bench/left_out.h"
#include "server/bench/ray_limits.h"
#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/results/summary_json.h"
#include "server/settings/option_checks.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr const char* kDefaultSession = "sessions/samples/desk-walk";

// Instants spread evenly over the session, its two ends left out.
std::vector<BenchInput> choose_inputs(Session& session, const Scene& scene, int count) {
  std::vector<BenchInput> inputs;
  const auto length_ns = static_cast<double>(session.end_ns() - session.start_ns());
  for (int i = 0; i < count; ++i) {
    const TimeNs offset_ns = std::llround(length_ns * (i + 0.5) / count);
    BenchInput input;
    input.sample = session.sample(session.start_ns() + offset_ns);
    scene_state_at(scene, static_cast<double>(offset_ns) * kSecondsPerNs, input.state);
    inputs.push_back(std::move(input));
  }
  return inputs;
}

std::filesystem::path session_of(const BenchOptions& options) {
  if (!options.session.empty()) return options.session;
  if (!path_exists(kDefaultSession)) {
    throw UsageError(std::string("SESSION: missing, and there is no ") + kDefaultSession +
                     " here; name a session or run from the top folder of the source");
  }
  return kDefaultSession;
}

// Each instant many times over: medians.
int measure_frames(const BenchOptions& options, const Scene& scene, bool camera,
                   const std::vector<BenchInput>& inputs, BenchSubject& subject) {
  Renderer renderer(scene, subject.profile, options.render, camera);
  subject.settings = renderer.settings();
  const BenchResult result = bench_frames(renderer, inputs, options.repeats);
  print_result(options.json ? json_text(bench_json(result, subject)) : bench_table(result, subject));
  const std::string excess =
      rays_beyond_plan(result, renderer.plan(), scene.lights.size(), renderer.settings());
  if (excess.empty()) return kExitDone;
  print_message(excess);
  return kExitInternal;
}

// Runs of the same length for each size of the polar buffer and each number of light samples: means.
int average_frames(const BenchOptions& options, const Scene& scene, bool camera,
                   const std::vector<BenchInput>& inputs, BenchSubject& subject) {
  std::vector<FrameTimeRow> rows = empty_table(options.render, options.polar_given);
  for (FrameTimeRow& row : rows) {
    for (std::size_t i = 0; i < kTableLightSamples.size(); ++i) {
      RenderSettings settings = options.render;
      settings.polar_width = row.polar_width;
      settings.polar_height = row.polar_height;
      settings.light_samples = kTableLightSamples[i];
      Renderer renderer(scene, subject.profile, settings, camera);
      subject.settings = renderer.settings();
      const auto input = [&](int k) { return spread_input(inputs, k, subject.profile.display_hz); };
      row.cells[i] = bench_run(renderer, input, options.seconds);
    }
  }
  print_result(options.json ? json_text(frame_times_json(rows, subject, options.seconds))
                            : frame_times_table(rows, subject, options.seconds));
  return kExitDone;
}

// Each instant with and without what the frame plan leaves out.
int weigh_left_out(const BenchOptions& options, const Scene& scene, bool camera,
                   const std::vector<BenchInput>& inputs, BenchSubject& subject) {
  subject.settings = Renderer(scene, subject.profile, options.render, camera).settings();
  const LeftOutResult result =
      measure_left_out(scene, subject.profile, options.render, camera, inputs, options.repeats);
  print_result(options.json ? json_text(left_out_json(result, subject)) : left_out_table(result, subject));
  const std::string changed = changed_picture(result);
  if (changed.empty()) return kExitDone;
  print_message(changed);
  return kExitInternal;
}

}  // namespace

int run_bench(const BenchOptions& options) {
  end_at_once_on_signal();  // nothing is written, and half a measurement is none
  if (const int signal = stop_signal(); signal != 0) return kExitSignalBase + signal;
  check_isa(options.render);
  Session session = Session::open(session_of(options));
  const SessionHeader& header = session.header();
  if (options.scene.empty() && header.scene.empty()) {
    throw UsageError("--scene: the session names no scene; give --scene FILE");
  }
  const std::filesystem::path scene_file =
      options.scene.empty() ? session.folder() / header.scene : std::filesystem::path(options.scene);
  const Scene scene = load_scene(scene_file);
  const DisplayProfile profile =
      options.profile.empty() ? header.profile : load_display_profile(options.profile);
  BenchSubject subject;
  subject.session = header.name;
  subject.scene = scene.name;
  subject.cpu_name = cpu_name();
  subject.triangles = triangle_count(scene, false);
  subject.profile = profile;
  const std::vector<BenchInput> inputs = choose_inputs(session, scene, options.frames);
  const bool camera = session.findings().camera_rows[0] > 0;
  if (options.left_out) return weigh_left_out(options, scene, camera, inputs, subject);
  return options.table ? average_frames(options, scene, camera, inputs, subject)
                       : measure_frames(options, scene, camera, inputs, subject);
}

}  // namespace herr
