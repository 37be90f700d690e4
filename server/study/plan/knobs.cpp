#include "server/study/plan/knobs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "renderer/settings_list.h"
#include "server/text/number_text.h"
#include "server/text/text_number.h"

namespace herr {
namespace {

// How one setting is swept.
struct KnobRow {
  const char* setting = "";
  std::vector<std::string> values = {};  // around hard light; empty: from its range
  std::vector<std::string> soft = {};    // of these, around soft light, whose frames take long; empty: all
  OwnReference own = OwnReference::pixels;
  SettingChanges limit = {};    // for OwnReference::seeds
  SettingChanges needs = {};    // without these it does nothing
  const char* plan_entry = "";  // that runs where the scene has something for it
  const char* effort = "";
  const char* theory = "";
  int expected = 0;
  double fit_from = 0;
  bool soft_only = false;
};

// Most wanted first: what the time is too short for is dropped from the end.
const std::vector<KnobRow>& knob_rows() {
  constexpr auto seeds = OwnReference::seeds;
  static const std::vector<KnobRow> rows{
      {.setting = "first_light_samples",
       .values = {"4", "8", "16", "32"},
       .own = seeds,
       .limit = {{"first_light_samples", "0"}},
       .needs = {{"first_light_samples", "8"}},
       .plan_entry = "adaptive light samples",
       .effort = "first samples",
       .expected = 1,
       .soft_only = true},
      {.setting = "filter", .values = {"nearest", "bilinear", "bicubic"}},
      {.setting = "edge_samples", .values = {"0", "2", "4", "8"}, .soft = {"0", "4"}},
      {.setting = "reflections",
       .values = {"off", "on"},
       .own = seeds,
       .limit = {{"reflections", "on"}},
       .plan_entry = "mirror rays"},
      {.setting = "refraction",
       .values = {"off", "on"},
       .own = seeds,
       .limit = {{"refraction", "on"}},
       .plan_entry = "refraction"},
      {.setting = "occlusion_rays",
       .values = {"0", "1", "2", "4", "8", "16"},
       .soft = {"0", "4", "16"},
       .own = seeds,
       .limit = {{"occlusion_rays", "64"}, {"occlusion_smoothing", "off"}},
       .needs = {{"occlusion_rays", "16"}},
       .plan_entry = "ambient occlusion",
       .effort = "rays per hit",
       .theory = "-0.5 for independent rays, less where they are spread",
       .expected = 1,
       .fit_from = 1},
      {.setting = "occlusion_smoothing",
       .values = {"off", "on"},
       .own = seeds,
       .limit = {{"occlusion_rays", "64"}, {"occlusion_smoothing", "off"}},
       .needs = {{"occlusion_rays", "1"}},
       .plan_entry = "ambient occlusion"},
      {.setting = "ray_width",
       .values = {"0", "0.5", "1", "2", "4"},
       .soft = {"0", "1", "4"},
       .plan_entry = "textures",
       .effort = "width of rays in samples"},
      {.setting = "detail_error",
       .values = {"0", "0.25", "0.5", "1", "2", "4"},
       .soft = {"0", "0.5", "4"},
       .plan_entry = "detail levels",
       .effort = "samples that a mesh may lie off",
       .expected = -1,
       .fit_from = 0.01},
      {.setting = "probe_rays",
       .values = {"16", "32", "64", "128"},
       .soft = {"16", "64"},
       .own = seeds,
       .limit = {{"probe_rays", "256"}},
       .needs = {{"probes", "on"}},
       .plan_entry = "probes",
       .effort = "rays per probe and update",
       .theory = "-0.5: independent rays",
       .expected = 1},
      {.setting = "probe_density",
       .values = {"0.35", "0.5", "0.71", "1"},
       .soft = {"0.5", "1"},
       .own = seeds,
       .limit = {{"probe_density", "1.41"}},
       .needs = {{"probes", "on"}},
       .plan_entry = "probes",
       .effort = "probes per axis",
       .expected = 1},
      {.setting = "probe_budget",
       .values = {"128", "512", "0"},
       .soft = {"128", "0"},
       .own = seeds,
       .limit = {{"probe_budget", "0"}},
       .needs = {{"probes", "on"}},
       .plan_entry = "probes"},
  };
  return rows;
}

// Swept by functions of their own below.
constexpr std::array kOwnSweeps{"foveation", "scale", "polar", "light_samples"};

bool has_row(const std::string& setting) {
  const auto& rows = knob_rows();
  return std::any_of(rows.begin(), rows.end(), [&](const KnobRow& row) { return setting == row.setting; }) ||
         std::find(kOwnSweeps.begin(), kOwnSweeps.end(), setting) != kOwnSweeps.end();
}

std::vector<std::string> values_around(const Setting& setting) {
  if (const auto* words = std::get_if<WordSetting>(&setting.value)) return words->words;
  const auto* number = std::get_if<NumberSetting>(&setting.value);
  if (number == nullptr) return {};
  const double middle = number->get().value_or(number->lowest);
  std::vector<std::string> values;
  for (const double factor : {0.25, 0.5, 1.0, 2.0, 4.0}) {
    double value = std::clamp(middle * factor, number->lowest, number->highest);
    if (number->step > 0) value = std::round(value / number->step) * number->step;
    const std::string text = shortest_text(value);
    if (values.empty() || values.back() != text) values.push_back(text);
  }
  return values;
}

class Sweeps {
 public:
  Sweeps(const RenderSettings& defaults, const std::function<FramePlan(const RenderSettings&)>& plan_of)
      : defaults_(defaults), plan_of_(plan_of) {}

  void add_bases();
  void add_light_samples();
  void add_polar();
  void add_uniform();
  void add_paper();
  void add_adaptive();
  void add_row(const KnobRow& row);
  void add_unknown();
  StudySweeps take() { return std::move(out_); }

 private:
  SettingChanges light(int samples) const { return {{"light_samples", std::to_string(samples)}}; }
  // Hard light has a reference of its own; soft light's is the picture of endless effort.
  static OwnReference by_pixels(int samples) {
    return samples == kHardSamples ? OwnReference::pixels : OwnReference::none;
  }
  StudySetting& add(const Knob& knob, const std::string& value, int samples, SettingChanges changes) {
    StudySetting setting;
    setting.knob = knob.name;
    setting.base = base_name(samples);
    setting.value = value;
    setting.name = knob.label + " " + value + ", " + setting.base;
    setting.n = knob.effort.empty() ? 0 : number_in(value).value_or(0);
    setting.changes = changes_between(defaults_, with_changes(defaults_, merged(light(samples), changes)));
    setting.own = by_pixels(samples);
    out_.settings.push_back(std::move(setting));
    return out_.settings.back();
  }
  // What of `needs` the picture of endless effort shows: that there is such light where the default has none.
  // How many samples and rays it is made of is no part of the picture.
  SettingChanges model_of(SettingChanges needs) const {
    std::erase_if(needs, [&](const auto& change) {
      return !((change.first == "probes" && !defaults_.probes.on) ||
               (change.first == "occlusion_rays" && defaults_.occlusion_rays == 0));
    });
    return needs;
  }
  // Within the range of the setting.
  std::string polar_text(double width_factor, double height_factor) const {
    RenderSettings any = defaults_;
    const std::vector<Setting> rows = settings_of(any);
    const auto& size = std::get<SizeSetting>(setting_named(rows, "polar").value);
    const auto scaled = [](int value, double factor, int most) {
      return std::clamp(static_cast<int>(std::lround(value * factor)), 1, most);
    };
    const int width = scaled(defaults_.polar_width, width_factor, size.widest_per_eye);
    const int pairs_of_rows = scaled(defaults_.polar_height / 2, height_factor, size.highest / 2);
    return std::to_string(2 * width) + "x" + std::to_string(2 * pairs_of_rows);
  }

  const RenderSettings& defaults_;
  const std::function<FramePlan(const RenderSettings&)>& plan_of_;
  StudySweeps out_;
};

void Sweeps::add_bases() {
  const Knob knob{"default", "default", "", "", 0, 0};
  out_.knobs.push_back(knob);
  for (const int samples : {kHardSamples, kSoftSamples}) {
    add(knob, "", samples, {}).name = default_name(samples);
  }
}

void Sweeps::add_light_samples() {
  const Knob knob{"light_samples",
                  "light samples",
                  "samples per light",
                  "-0.75 along the edge of a flat light, -0.67 of a box: strata; -0.5 if independent",
                  1,
                  2};
  out_.knobs.push_back(knob);
  for (const int samples : {1, 4, 8, 16, 32, 64, 256}) {
    StudySetting& setting = add(knob, std::to_string(samples), samples, {});
    setting.name = "light samples " + std::to_string(samples);
    setting.base = "";
    setting.own = OwnReference::seeds;
    setting.own_limit = light(kSoftSamples);
  }
}

void Sweeps::add_polar() {
  const Knob both{
      "polar", "polar", "polar samples per side", "-2 on smooth shading (bilinear), -0.5 across edges", 1, 0};
  const Knob width{"polar_width", "polar width", "radial samples", "", 1, 0};
  const Knob height{"polar_height", "polar height", "angular samples", "", 1, 0};
  out_.knobs.insert(out_.knobs.end(), {both, width, height});
  const auto sweep = [&](const Knob& knob, int samples, std::initializer_list<double> factors) {
    std::string last;
    for (const double factor : factors) {
      const std::string text =
          polar_text(knob.name == "polar_height" ? 1 : factor, knob.name == "polar_width" ? 1 : factor);
      if (text == last) continue;  // at an end of the range
      last = text;
      StudySetting& setting = add(knob, text, samples, {{"polar", text}});
      const RenderSettings sized = with_changes(defaults_, setting.changes);
      const double w = sized.polar_width, h = sized.polar_height;
      setting.n = knob.name == "polar" ? std::sqrt(w * h) : knob.name == "polar_width" ? w : h;
    }
  };
  // Frames with soft light take long: fewer of them.
  for (const int samples : {kHardSamples, kSoftSamples}) {
    if (defaults_.polar_acuity) break;                          // the default itself
    add(both, "acuity", samples, {{"polar", "acuity"}}).n = 0;  // each frame has a size of its own
  }
  sweep(both, kHardSamples, {0.25, 0.354, 0.5, 0.707, 1, 1.414, 2});
  sweep(both, kSoftSamples, {0.25, 0.5, 0.707, 1, 1.414});
  sweep(width, kHardSamples, {0.25, 0.5, 1, 2});
  sweep(height, kHardSamples, {0.25, 0.5, 1, 2});
  sweep(width, kSoftSamples, {0.25, 0.5, 1});
  sweep(height, kSoftSamples, {0.25, 0.5, 1});
}

void Sweeps::add_uniform() {
  const Knob knob{"uniform",
                  "rays per pixel at scale",
                  "rays per pixel and axis",
                  "-2 on smooth shading, -0.5 across edges",
                  1,
                  0};
  out_.knobs.push_back(knob);
  for (const double scale : {0.177, 0.25, 0.354, 0.5, 0.707, 1.0}) {
    for (const int samples : {1, 16, 64}) {
      const std::string text = shortest_text(scale);
      add(knob, text, samples, {{"foveation", "off"}, {"scale", text}, {"covered_pixels", "off"}});
    }
  }
}

void Sweeps::add_paper() {
  const Knob knob{"paper", "the paper's", "", "", 0, 0};
  out_.knobs.push_back(knob);
  for (const char* polar : {"1576x768", "2048x1024"}) {
    for (const int samples : {1, 64, 256}) add(knob, polar, samples, {{"polar", polar}});
  }
}

// Adaptive samples against all: hits of penumbrae look at no more than some strata, whose noise stays.
void Sweeps::add_adaptive() {
  RenderSettings trial = with_changes(defaults_, {{"light_samples", "64"}, {"first_light_samples", "8"}});
  if (!plan_of_(trial).light_sampling(64).adaptive()) return;
  const Knob knob{"adaptive_samples",
                  "adaptive light samples",
                  "samples per light",
                  "as all samples up to 32, of which hits trace no more in penumbrae",
                  1,
                  2};
  out_.knobs.push_back(knob);
  for (const int samples : {16, 32, 64, 128, 256}) {
    StudySetting& setting = add(knob, std::to_string(samples), samples, {{"first_light_samples", "8"}});
    setting.name = "adaptive light samples " + std::to_string(samples);
    setting.base = "";
    setting.own = OwnReference::seeds;
    setting.own_limit = merged(light(kSoftSamples), {{"first_light_samples", "0"}});
  }
}

void Sweeps::add_row(const KnobRow& row) {
  RenderSettings current = defaults_;
  const std::vector<Setting> rows = settings_of(current);
  const Setting& setting = setting_named(rows, row.setting);
  const Knob knob{row.setting, label_of(setting), row.effort, row.theory, row.expected, row.fit_from};
  if (*row.plan_entry != '\0') {
    const FramePlan plan = plan_of_(with_changes(defaults_, merged(light(kSoftSamples), row.needs)));
    const auto entry = std::find_if(plan.entries.begin(), plan.entries.end(),
                                    [&](const PlanEntry& e) { return e.name == row.plan_entry; });
    // Voxels have levels as textures have.
    const bool levels = std::string("textures") == row.plan_entry && plan.voxels;
    if (entry != plan.entries.end() && !entry->runs && !levels) {
      out_.left_out.push_back(knob.label + ": " + entry->reason);
      return;
    }
  }
  out_.knobs.push_back(knob);
  const std::vector<std::string> values = row.values.empty() ? values_around(setting) : row.values;
  for (const std::string& value : values) {
    for (const int samples : {kHardSamples, kSoftSamples}) {
      if (row.soft_only && samples == kHardSamples) continue;
      if (samples == kSoftSamples && !row.soft.empty() &&
          std::find(row.soft.begin(), row.soft.end(), value) == row.soft.end()) {
        continue;
      }
      StudySetting& added = add(knob, value, samples, merged(row.needs, {{row.setting, value}}));
      added.model = model_of(row.needs);
      if (row.own == OwnReference::pixels) continue;
      added.own = row.own;
      added.own_limit = row.limit;
    }
  }
}

void Sweeps::add_unknown() {
  RenderSettings current = defaults_;
  for (const Setting& setting : settings_of(current)) {
    if (setting.effect != SettingEffect::error_for_time || has_row(setting.name)) continue;
    const bool number = std::holds_alternative<NumberSetting>(setting.value);
    add_row({.setting = setting.name.c_str(), .effort = number ? "its value" : ""});
  }
}

// What no frame need be rendered for: the default's own frames show it, against the same references.
void take_out_defaults(StudySweeps& sweeps) {
  const auto is_default = [&](const StudySetting& setting) {
    return setting.knob != "default" &&
           std::any_of(sweeps.settings.begin(), sweeps.settings.end(), [&](const StudySetting& other) {
             return other.knob == "default" && other.changes == setting.changes && other.own == setting.own &&
                    other.base == setting.base;
           });
  };
  std::vector<StudySetting> rest;
  for (const StudySetting& setting : sweeps.settings)
    (is_default(setting) ? sweeps.of_default : rest).push_back(setting);
  sweeps.settings = std::move(rest);
}

}  // namespace

std::string base_name(int samples) {
  return "N = " + std::to_string(samples);
}

std::string default_name(int samples) {
  return "default, " + base_name(samples);
}

StudySweeps sweeps_of(const RenderSettings& defaults,
                      const std::function<FramePlan(const RenderSettings&)>& plan_of) {
  Sweeps sweeps(defaults, plan_of);
  sweeps.add_bases();
  sweeps.add_light_samples();
  sweeps.add_polar();
  sweeps.add_uniform();
  sweeps.add_paper();
  sweeps.add_adaptive();
  for (const KnobRow& row : knob_rows()) sweeps.add_row(row);
  sweeps.add_unknown();
  StudySweeps all = sweeps.take();
  take_out_defaults(all);
  return all;
}

}  // namespace herr
