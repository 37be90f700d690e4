#include "server/results/fingerprint.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <set>
#include <system_error>

#include "renderer/settings_presets.h"
#include "server/process/version.h"
#include "server/results/settings_report.h"
#include "server/settings/quality_target.h"
#include "server/settings/run_settings.h"
#include "server/settings/view_file.h"
#include "server/text/number_text.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

// Guards against change by accident; nobody forges a session to get a wrong picture.
class Checksum {
 public:
  void add(const void* bytes, std::size_t count) {
    crc_ = ::crc32_z(crc_, static_cast<const Bytef*>(bytes), count);
    bytes_ += static_cast<std::int64_t>(count);
  }
  std::string text() const { return std::to_string(bytes_) + " bytes, crc32 " + std::to_string(crc_); }
  std::uint64_t crc() const { return crc_; }

 private:
  uLong crc_ = ::crc32_z(0, nullptr, 0);
  std::int64_t bytes_ = 0;
};

std::string content_text(const fs::path& path) {
  InputFile file(path);
  Checksum sum;
  std::vector<char> block(1 << 16);
  while (const std::size_t got = file.read(block.data(), block.size())) sum.add(block.data(), got);
  return sum.text();
}

// Times of change in checkpoints count from 2174, as std::filesystem does.
constexpr std::int64_t kFileClockEpochNs = 6'437'664'000'000'000'000;

// Images are too many to read: a session of an hour has 100,000. The sum does not depend on their order.
std::string images_text(const fs::path& folder, PictureIdentity identity) {
  std::uint64_t count = 0, sum = 0;
  std::error_code error;
  for (const fs::path& file : list_tree(folder, error)) {
    const FileFacts facts = facts_of(file);
    if (facts.kind != FileKind::file) continue;  // a folder, or a broken link
    std::string text = file.lexically_relative(folder).string() + ' ' + std::to_string(facts.size_bytes);
    if (identity == PictureIdentity::size_and_time)
      text += ' ' + std::to_string(facts.changed_ns - kFileClockEpochNs);
    Checksum checksum;
    checksum.add(text.data(), text.size());
    sum += checksum.crc();
    ++count;
  }
  if (error) throw InputError(folder, 0, "cannot be listed: " + error.message(), "check its permissions");
  return std::to_string(count) + " files, checksum " + std::to_string(sum);
}

std::string profile_text(const DisplayProfile& profile) {
  std::string text = shortest_text(profile.display_hz) + " Hz";
  for (const Viewport& v : profile.viewports) {
    text += "; " + v.name + (v.eye == Eye::left ? " left " : " right ") + (v.focus ? "focus " : "context ") +
            std::to_string(v.width_px) + 'x' + std::to_string(v.height_px);
    for (const double value : {v.tan_left, v.tan_right, v.tan_down, v.tan_up, v.edge_blend_deg}) {
      text += ' ' + shortest_text(value);
    }
  }
  Checksum sum;
  sum.add(text.data(), text.size());
  return sum.text();
}

constexpr const char* kNotGiven = "not given";
constexpr const char* kOcclusionRays = "--occlusion-rays";

// The flag that sets it. Of a switch whose default has changed since, the one that changed it then.
std::string recorded_name(const Setting& setting) {
  if (!setting.back_flag.empty()) return setting.back_flag;
  return setting.flag.empty() ? setting.name : setting.flag;
}

// Of a switch, whether that flag is given.
std::string recorded_text(const Setting& setting, const ReplayOptions& options) {
  const std::string text = text_of(setting);
  if (setting.name == "polar_floor") return std::to_string(2 * narrowest_width(options, options.render));
  if (setting.name == "probes" && options.render.probes.on) {  // as the first checkpoints told it
    return std::to_string(options.render.probes.rays) + " rays, budget " +
           std::to_string(options.render.probes.budget);
  }
  if (setting.name == "occlusion_smoothing" && options.render.occlusion_rays == 0) return "given";  // as ever
  if (!is_switch(setting) || setting.flag.empty()) return text;
  const bool given = (text == "on") != recorded_name(setting).starts_with("--no-");
  return given ? "given" : kNotGiven;
}

// What shapes pictures, and which files a run leaves. Threads change no picture. Nor do --keep-going and
// --strict: what they let pass or refuse is found by the check of the session, before the first frame, or
// ends the run.
}  // namespace

Fingerprint::Entries setting_entries(ReplayOptions options) {
  Fingerprint::Entries entries;
  for (const Setting& setting : settings_of(options)) {
    if (!shapes_pictures(setting) && setting.group != SettingGroup::files) continue;
    entries.emplace_back(recorded_name(setting), recorded_text(setting, options));
  }
  return entries;
}

namespace {

Fingerprint::Entries settings_of_run(const SessionReport& report, const ReplayOptions& options) {
  Fingerprint::Entries entries{{"the program", program_with_version()},
                               {"--scene", printable(report.scene_file.filename().string())}};
  const Fingerprint::Entries settings = setting_entries(resolved_options(options, report));
  entries.insert(entries.end(), settings.begin(), settings.end());
  entries.emplace_back("--start, --duration, --frames",
                       "frames " + std::to_string(report.range.first) + " ... " +
                           std::to_string(report.range.first + report.range.count - 1));
  return entries;
}

fs::path relative_to(const fs::path& folder, const fs::path& file) {
  return fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder));
}

// Of a file that a scene names: where it lies below the scene's folder, else the first asset root that holds
// it, by its number, and where it lies below that; else how it is reached from the scene's folder. No two
// files have one name.
std::string name_of_input(const fs::path& file, const SessionReport& report, const ReplayOptions& options) {
  const auto inside = [](const fs::path& name) { return !name.empty() && *name.begin() != ".."; };
  const fs::path own = relative_to(fs::absolute(report.scene_file).parent_path(), file);
  for (std::size_t i = 0; i < options.asset_roots.size() && !inside(own); ++i) {
    const fs::path name = relative_to(options.asset_roots[i], file);
    if (inside(name)) return "asset root " + std::to_string(i + 1) + '/' + printable(name.generic_string());
  }
  return printable(own.generic_string());
}

Fingerprint::Entries inputs_of(const SessionReport& report, const ReplayOptions& options, const Scene& scene,
                               PictureIdentity identity) {
  Fingerprint::Entries inputs;
  const fs::path& session = report.session_folder;
  for (const char* name :
       {"session.json", "pose/data.csv", "gaze/data.csv", "cam0/data.csv", "cam1/data.csv", "events.jsonl"}) {
    if (path_exists(session / name)) inputs.emplace_back(name, content_text(session / name));
  }
  for (const char* name : {"cam0/data", "cam1/data"}) {
    if (is_folder(session / name)) inputs.emplace_back(name, images_text(session / name, identity));
  }
  const std::set<fs::path> files(scene.files.begin(), scene.files.end());
  for (const fs::path& file : files)
    inputs.emplace_back(name_of_input(file, report, options), content_text(file));
  inputs.emplace_back("the display profile", profile_text(report.profile));
  if (report.settings.outside) inputs.emplace_back("the view", view_text(*report.settings.outside));
  return inputs;
}

const std::string* find(const Fingerprint::Entries& entries, const std::string& name) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.first == name; });
  return found == entries.end() ? nullptr : &found->second;
}

const Setting* recorded_setting(const std::vector<Setting>& settings, const std::string& name) {
  const auto found = std::find_if(settings.begin(), settings.end(),
                                  [&](const Setting& setting) { return recorded_name(setting) == name; });
  return found == settings.end() ? nullptr : &*found;
}

// A value that is none in words: "the camera feed". What a preset turns off is off, whoever gave which flag.
std::string in_words(const std::vector<Setting>& settings, const std::string& name,
                     const std::string& value) {
  const Setting* setting = recorded_setting(settings, name);
  if (value == kNotGiven && setting != nullptr && !setting->back_flag.empty()) return "off";
  if (!value.empty()) return value;
  return setting == nullptr || setting->otherwise.empty() ? "none" : setting->otherwise;
}

// Without short rays there is no mean over them, which is then recorded as left out.
bool follows_from_no_rays(const std::string& name, const Fingerprint& earlier, const Fingerprint& now) {
  if (name != "--no-occlusion-smoothing") return false;
  const std::string* before = find(earlier.settings, kOcclusionRays);
  const std::string* after = find(now.settings, kOcclusionRays);
  return before != nullptr && after != nullptr && *before != *after && (*before == "0" || *after == "0");
}

}  // namespace

Fingerprint fingerprint_of(const SessionReport& report, const ReplayOptions& options, const Scene& scene,
                           PictureIdentity identity) {
  return {settings_of_run(report, options), inputs_of(report, options, scene, identity)};
}

std::vector<FingerprintDifference> differences(const Fingerprint& earlier, const Fingerprint& now) {
  ReplayOptions without;
  without.render = direct_light_settings();
  without.render.occlusion_smoothing = false;
  const std::vector<Setting> settings = settings_of(without);
  const Fingerprint::Entries defaults = setting_entries(without);
  std::vector<FingerprintDifference> found;
  for (const auto& [name, value] : now.settings) {
    const std::string* before = find(earlier.settings, name);
    // A program that did not know a setting had its default, no light but direct light, and no mean over
    // short rays.
    const std::string* unknown = before == nullptr ? find(defaults, name) : nullptr;
    if (unknown != nullptr && *unknown == value) continue;
    if (follows_from_no_rays(name, earlier, now)) continue;
    const std::string is = ", is " + in_words(settings, name, value);
    if (before == nullptr) {
      found.push_back({name, false, name + " was not known then" + is});
    } else if (*before != value) {
      found.push_back({name, false, name + " was " + in_words(settings, name, *before) + is});
    }
  }
  for (const auto& [name, value] : now.inputs) {
    const std::string* before = find(earlier.inputs, name);
    if (before == nullptr) {
      found.push_back({name, true, name + " was not among the inputs"});
    } else if (*before != value) {
      found.push_back({name, true, name + " has changed"});
    }
  }
  for (const auto& [name, value] : earlier.inputs) {
    if (find(now.inputs, name) == nullptr)
      found.push_back({name, true, name + " is no longer among the inputs"});
  }
  return found;
}

std::string flags_of(const std::pair<std::string, std::string>& entry) {
  ReplayOptions any;
  const std::vector<Setting> settings = settings_of(any);
  const Setting* setting = recorded_setting(settings, entry.first);
  if (setting == nullptr || !is_switch(*setting)) return entry.first + " " + entry.second;
  if (entry.second != kNotGiven) return entry.first;
  return setting->back_flag.empty() ? "without " + entry.first : setting->flag;
}

std::string difference(const Fingerprint& earlier, const Fingerprint& now) {
  const std::vector<FingerprintDifference> found = differences(earlier, now);
  return found.empty() ? std::string() : found.front().text;
}

}  // namespace herr
