#include "server/settings/option_checks.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/settings_list.h"
#include "renderer/threads/cpu_use.h"
#include "server/process/exit_code.h"
#include "server/process/terminal.h"

namespace herr {
namespace {

void check_policy(const ReplayOptions& options) {
  const bool fixed = options.policy == QualityPolicy{};
  if (!fixed && options.render.foveation == Foveation::off) {
    throw UsageError(
        std::string("--policy ") + name_of(options.policy) +
        ": changes the width of polar buffers, and --foveation off has none; give one of the two");
  }
  if (options.lowest_height && !options.policy.deadline) {
    throw UsageError(
        "--polar-floor-height: only the policy deadline lowers polar buffers; give --policy deadline");
  }
  if (options.lowest_height && *options.lowest_height > options.render.polar_height) {
    throw UsageError("--polar-floor-height: is higher than --polar; give at most " +
                     std::to_string(options.render.polar_height));
  }
  if (!options.narrowest_width) return;
  if (fixed)
    throw UsageError(
        "--polar-floor: the policy fixed never goes below --polar; "
        "give --policy motion, deadline or motion+deadline");
  if (*options.narrowest_width > options.render.polar_width) {
    throw UsageError("--polar-floor: is wider than --polar; give at most " +
                     std::to_string(2 * options.render.polar_width));
  }
}

}  // namespace

void check_render_settings(const RenderSettings& settings) {
  if (settings.auto_exposure && settings.exposure_ev) {
    throw UsageError("--auto-exposure: chooses what --exposure states; give one of the two");
  }
  try {
    resolve_isa(settings.isa);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--isa: ") + error.what() + "; use --isa best");
  }
}

void warn_of_idle_settings(const RenderSettings& settings) {
  RenderSettings given = settings, defaults;
  std::vector<std::string> lines = idle_settings(settings_of(given), settings_of(defaults));
  for (std::string& line : lines) {
    const bool gives_value = settings.light_samples <= settings.adaptive_min_samples &&
                             settings.adaptive_min_samples < kMostAdaptiveSamples;
    if (line.starts_with("--first-light-samples ") && gives_value)
      line = line.substr(0, line.find(": ")) + ": no effect with --light-samples " +
             std::to_string(settings.light_samples) + ", which are traced at once; give --light-samples " +
             std::to_string(settings.adaptive_min_samples + 1) + " or more";
    print_message("warning: " + line + (line.find("; ") == std::string::npos ? "; " : ", or ") +
                  "leave it out");
  }
  warn_of_threads(settings.threads);
}

void warn_of_threads(int threads) {
  if (const std::string line = too_many_threads(threads, available_threads()); !line.empty())
    print_message("warning: " + line);
}

std::string too_many_threads(int threads, int cores) {
  if (threads <= cores) return {};
  return "--threads " + std::to_string(threads) + ": this process may use " +
         (cores == 1 ? std::string("1 core") : std::to_string(cores) + " cores") +
         ", and threads that share one wait for each other; give --threads " + std::to_string(cores) +
         ", or leave it out";
}

void check_replay_options(const ReplayOptions& options) {
  if (options.resume && options.overwrite) {
    throw UsageError("--resume: goes on with the results that --overwrite would remove; give one of the two");
  }
  if (options.resume && options.clock == ReplayClock::realtime) {
    throw UsageError("--resume: frames of the clock realtime cannot be taken up again; use another --clock");
  }
  if (options.resume && options.policy.deadline) {
    throw UsageError(
        "--resume: frames of the policy deadline depend on how long each took, and cannot be taken up again; "
        "give --overwrite to start again");
  }
  if (options.target_ms && options.clock != ReplayClock::realtime && !options.policy.deadline) {
    throw UsageError(
        "--target-ms: only the policy deadline and the clock realtime have one; give --policy deadline for "
        "frames of that time, or --clock realtime for ticks of that period");
  }
  check_policy(options);
  // Encoders on the render threads would make the frames late that they belong to.
  const bool pictures = !options.formats.empty() || options.sheet != SheetChoice::none;
  if (options.clock == ReplayClock::realtime && pictures) {
    throw UsageError(
        "--clock realtime: measures times and writes no pictures; give --format none --contact-sheet none");
  }
}

}  // namespace herr
