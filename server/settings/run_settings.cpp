#include "server/settings/run_settings.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "renderer/settings_list.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/files/nearest_name.h"
#include "sessions/format/display_profile.h"
#include "sessions/text/plain_values.h"

namespace herr {
namespace {

using Group = SettingGroup;
using Effect = SettingEffect;

constexpr double kLongestSeconds = 1e7;  // 115 days
constexpr double kSmallestProfileScale = 0.1;
constexpr int kWidestPolarBuffer = 16384, kHighestPolarBuffer = 8192;
constexpr std::array<QualityPolicy, 4> kPolicies{
    QualityPolicy{false, false}, {true, false}, {false, true}, {true, true}};

TextSetting path_setting(std::string& path, const char* form, const char* example) {
  const auto set = [&path](const std::string& text) {
    if (text.empty()) throw std::invalid_argument("the path is empty; give a file or folder");
    path = text;
  };
  return {[&path] { return path; }, set, form, example};
}

std::vector<std::string> names_of_profiles() {
  std::vector<std::string> names;
  const std::string all = builtin_display_profile_names();
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t end = std::min(all.find(", ", at), all.size());
    names.push_back(all.substr(at, end - at));
    at = end + 2;
  }
  return names;
}

// A word that is neither a profile nor a file is no value of the flag; a path that leads nowhere is a missing
// file, which is told when it is read.
TextSetting profile_name_or_file(std::string& profile) {
  TextSetting setting = path_setting(profile, "NAME|FILE", "xr1-half");
  const auto set_path = setting.set;
  setting.set = [set_path](const std::string& text) {
    const bool word = !text.empty() && text.find('/') == std::string::npos && !text.ends_with(".json");
    if (word && !builtin_display_profile(text) && !path_exists(text)) {
      std::string lower = text;
      for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
      const std::string nearest = nearest_name(lower, names_of_profiles());
      throw std::invalid_argument("'" + printable(text) + "' is neither a built-in display profile (" +
                                  builtin_display_profile_names() + ") nor a file; " +
                                  (nearest.empty() ? "give one of them, or the path of a JSON file"
                                                   : "did you mean " + nearest + "?"));
    }
    set_path(text);
  };
  return setting;
}

TextSetting format_setting(PictureFormats& formats) {
  return {[&formats] { return text_of(formats); },
          [&formats](const std::string& text) { formats = picture_formats_from(text); }, "NAME,...",
          "png,exr"};
}

WordSetting policy_name(QualityPolicy& policy) {
  WordSetting setting;
  setting.get = [&policy] {
    return static_cast<std::size_t>(std::find(kPolicies.begin(), kPolicies.end(), policy) -
                                    kPolicies.begin());
  };
  setting.set = [&policy](std::size_t index) { policy = kPolicies.at(index); };
  for (const QualityPolicy& each : kPolicies) setting.words.emplace_back(name_of(each));
  return setting;
}

// Of both eyes together, as --polar; the field has one eye.
NumberSetting width_of_both_eyes(std::optional<int>& per_eye) {
  NumberSetting setting;
  setting.get = [&per_eye]() -> std::optional<double> {
    if (!per_eye) return std::nullopt;
    return 2.0 * *per_eye;
  };
  setting.set = [&per_eye](std::optional<double> both) {
    per_eye.reset();
    if (both) per_eye = static_cast<int>(*both / 2);
  };
  setting.lowest = setting.step = 2;
  setting.highest = kWidestPolarBuffer;
  setting.optional = true;
  return setting;
}

NumberSetting even(std::optional<int>& number, double highest) {
  NumberSetting setting = whole(number, 2, highest);
  setting.step = 2;
  return setting;
}

// A word, or the number of a frame.
TextSetting sheet_choice(ReplayOptions& options) {
  constexpr std::size_t kWordCount = 3;  // before SheetChoice::one
  static const std::vector<std::string> kWords{"none", "all", "middle"};
  const auto get = [&options] {
    const auto index = static_cast<std::size_t>(options.sheet);
    return index < kWordCount ? kWords[index] : std::to_string(options.sheet_frame);
  };
  const auto set = [&options](const std::string& text) {
    if (!text.empty() && text.front() >= '0' && text.front() <= '9') {
      options.sheet_frame = whole_number_from(text, 0, kMostFrames);
      options.sheet = SheetChoice::one;
      return;
    }
    options.sheet = static_cast<SheetChoice>(word_from(text, kWords));
  };
  return {get, set, "WHICH", "all"};
}

// Rows: name, flag, unit, group, effect, sentence, value; then what holds where it has none.

std::vector<Setting> of_reading(ReplayOptions& o) {
  return {
      {"sampling", "--sampling", "", Group::session, Effect::pictures,
       "headset state: latest, predict or interpolate",
       one_of(o.session.sampling, {name_of(SamplingMode::latest), name_of(SamplingMode::predict),
                                   name_of(SamplingMode::interpolate)})},
      {"predict_cap_s", "", "s", Group::session, Effect::pictures,
       "the sampling predict never extrapolates further than this", real(o.session.predict_cap_s, 0, 10)},
      {"start_s", "--start", "s", Group::span, Effect::none, "begin this many seconds into the session",
       real(o.start_s, 0, kLongestSeconds)},
      {"duration_s", "--duration", "s", Group::span, Effect::none, "replay this many seconds",
       real(o.duration_s, 0, kLongestSeconds), "to the end"},
      {"frames", "--frames", "", Group::span, Effect::none, "replay at most this many frames",
       whole(o.frames, 1, kMostFrames), "all"},
  };
}

std::vector<Setting> of_time(ReplayOptions& o) {
  return {
      {"policy", "--policy", "", Group::time, Effect::error_for_time,
       "quality of each frame: fixed; motion: less while the head moves fast; deadline: what holds "
       "--target-ms (polar width and height, light samples, probes), from the floor upwards in some tens of "
       "frames; "
       "motion+deadline",
       policy_name(o.policy)},
      {"polar_floor", "--polar-floor", "", Group::time, Effect::error_for_time,
       "least width of the polar buffers, both eyes together, that a policy may choose",
       width_of_both_eyes(o.narrowest_width), "an eighth of that of --polar"},
      {"polar_floor_height", "--polar-floor-height", "", Group::time, Effect::error_for_time,
       "least height of the polar buffers, even, that the policy deadline may choose; width and height "
       "reach their least together",
       even(o.lowest_height, kHighestPolarBuffer), "a quarter of that of --polar"},
      {"clock", "--clock", "", Group::time, Effect::pictures,
       "virtual: one display period per frame; realtime: late frames drop; max: as fast as it goes",
       one_of(o.clock, {name_of(ReplayClock::virtual_time), name_of(ReplayClock::realtime),
                        name_of(ReplayClock::max)})},
      {"target_ms", "--target-ms", "ms", Group::time, Effect::error_for_time,
       "display period of the clock realtime, time of a frame of the policy deadline",
       real(o.target_ms, 1, 10000), "the profile's"},
  };
}

std::vector<Setting> of_files(ReplayOptions& o) {
  return {
      {"format", "--format", "", Group::files, Effect::none,
       "pictures: png, exr, both as png,exr, or none; contact sheets are PNG whatever it says",
       format_setting(o.formats)},
      {"contact_sheet", "--contact-sheet", "", Group::files, Effect::none,
       "viewports and further views in one picture: none, all, middle or a frame number", sheet_choice(o)},
  };
}

std::vector<Setting> of_views(ReplayOptions& o) {
  return {
      {"view", "--view", "", Group::views, Effect::pictures,
       "a further picture, from a camera outside the headset that this file places (fields: "
       "server/settings/README.md): the scene, with head, gaze and frusta drawn in",
       path_setting(o.view, "FILE", "overview.view.json"), "none"},
  };
}

}  // namespace

Setting profile_setting(std::string& profile) {
  return {"profile",
          "--profile",
          "",
          Group::session,
          Effect::pictures,
          "display profile: " + builtin_display_profile_names() + " or a file",
          profile_name_or_file(profile),
          "the session's"};
}

std::vector<Setting> profile_settings(std::string& profile, double& scale) {
  return {profile_setting(profile),
          {"profile_scale", "--profile-scale", "", Group::session, Effect::pictures,
           "pixels of each viewport along each axis, against the profile's; its field of view stays",
           real(scale, kSmallestProfileScale, 1)}};
}

std::string profile_words(const std::string& name, double scale) {
  return scale == 1 ? name : name + " at scale " + plain_number_text(scale);
}

std::vector<Setting> settings_of(ReplayOptions& options) {
  std::vector<Setting> all = settings_of(options.render);
  for (const std::vector<Setting>& part :
       {profile_settings(options.profile, options.profile_scale), of_reading(options), of_time(options),
        of_files(options), of_views(options)}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace herr
