// One setting: its names, which values it may have, what another value changes, and where its value lies.
// Lists of settings are made for the struct that holds the values (renderer/settings_list.h for a render,
// server/settings/run_settings.h for a run). Flags and their help, range checks, JSON, fingerprints and texts
// in file headers are made from the lists: a new setting is a field and a row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace herr {

// Which settings stand together in a help, and which commands have them.
enum class SettingGroup { session, look, rays, probes, time, span, files, views, machine };

// What another value changes.
enum class SettingEffect {
  none,            // no pixel: threads, names of files
  pictures,        // pixels: another picture
  error_for_time,  // pixels: nearer to, or farther from, the picture that endless time would give
};

// A number, or none where the struct leaves it to something else ("0: all threads").
struct NumberSetting {
  std::function<std::optional<double>()> get;
  std::function<void(std::optional<double>)> set;
  double lowest = 0, highest = 0;
  int step = 0;           // whole multiples of it; 0: any number
  bool optional = false;  // may be none
};

// One of a few words. A switch has the words "off" and "on".
struct WordSetting {
  std::function<std::size_t()> get;
  std::function<void(std::size_t)> set;
  std::vector<std::string> words;
};

// Width and height of the polar buffers, written WIDTHxHEIGHT with the width of both eyes together; or the
// word `following`: as each frame asks for, up to a size that stands in their place then.
struct SizeSetting {
  int* width_per_eye = nullptr;
  int* height = nullptr;
  int widest_per_eye = 0, highest = 0;
  bool* follows = nullptr;
  std::string following;
  int following_per_eye = 0, following_height = 0;
};

// Words that only the setting understands. `set` throws std::invalid_argument as set_text() does.
struct TextSetting {
  std::function<std::string()> get;
  std::function<void(const std::string&)> set;
  std::string form;     // what a help calls it: "NAME|FILE"
  std::string example;  // a text that it takes
};

struct Setting {
  std::string name;  // of the JSON key: light_samples; ends with the unit
  std::string flag;  // --light-samples; of a switch the flag that changes it: --no-camera; empty: no flag
  std::string unit;  // m, s, ms; empty: a count, a share or no number
  SettingGroup group = SettingGroup::rays;
  SettingEffect effect = SettingEffect::none;
  std::string sentence;  // what it does, or what its flag does; says what each word means
  std::variant<NumberSetting, WordSetting, SizeSetting, TextSetting> value;
  std::string otherwise = {};  // what holds where an optional number or a text is none: "the profile's"
  std::string back_flag = {};  // of a switch that a preset turns: the flag that brings the default back
  // Beside what its value changes nothing, as the others stand now, and what to do ("--foveation off, which
  // has no polar buffer"); empty where it changes something.
  std::function<std::string()> idle_beside = {};
};

// A value as JSON has it; std::monostate: none.
using PlainValue = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

bool is_switch(const Setting& setting);
bool is_idle(const Setting& setting);
// "--polar acuity: no effect with --foveation off, ..." for each setting that has another value than its row
// in `defaults` and changes nothing beside the others. Both have the same rows.
std::vector<std::string> idle_settings(const std::vector<Setting>& settings,
                                       const std::vector<Setting>& defaults);
bool shapes_pictures(const Setting& setting);
// Its name for people: "light samples", without unit.
std::string label_of(const Setting& setting);

// The value as flags take it: "64", "0.3", "off", "1576x768"; empty where it is none.
std::string text_of(const Setting& setting);
PlainValue value_of(const Setting& setting);
// Throws std::invalid_argument and changes nothing when it takes no such value: "'0' is not a whole number
// from 1 to 4096; write plain decimal digits". A text is read strictly; a value has its own type, and whole
// numbers are taken for real ones.
void set_text(const Setting& setting, const std::string& text);
void set_value(const Setting& setting, const PlainValue& value);
// Throws std::invalid_argument when a program has put a value out of range: "light samples must lie in
// [1, 4096], not 0".
void check_range(const Setting& setting);
// "1 ... 4096", "log-polar, off"; empty for other texts.
std::string range_text(const Setting& setting);
// A value that it may have and has not.
std::string other_text(const Setting& setting);

// Throws std::invalid_argument that names the nearest one when none has that name.
const Setting& setting_named(const std::vector<Setting>& settings, const std::string& name);

// Makers of values. What they refer to must outlive them and stay where it is.
template <typename Number>
NumberSetting number_setting(Number& value, double lowest, double highest, int step) {
  return {[&value]() -> std::optional<double> { return static_cast<double>(value); },
          [&value](std::optional<double> number) { value = static_cast<Number>(*number); },
          lowest,
          highest,
          step,
          false};
}
template <typename Number>
NumberSetting number_setting(std::optional<Number>& value, double lowest, double highest, int step) {
  return {[&value]() -> std::optional<double> {
            if (!value) return std::nullopt;
            return static_cast<double>(*value);
          },
          [&value](std::optional<double> number) {
            value.reset();
            if (number) value = static_cast<Number>(*number);
          },
          lowest,
          highest,
          step,
          true};
}
template <typename Number>
NumberSetting whole(Number& value, double lowest, double highest) {
  return number_setting(value, lowest, highest, 1);
}
template <typename Number>
NumberSetting real(Number& value, double lowest, double highest) {
  return number_setting(value, lowest, highest, 0);
}
// The struct has 0 for none.
NumberSetting whole_or_zero(int& value, double lowest, double highest);
// `words` in the order of the enumerators, which count from 0.
template <typename Enum>
WordSetting one_of(Enum& value, std::vector<std::string> words) {
  return {[&value] { return static_cast<std::size_t>(value); },
          [&value](std::size_t index) { value = static_cast<Enum>(index); }, std::move(words)};
}
WordSetting on_off(bool& value);

}  // namespace herr
