#include "renderer/setting.h"

#include <algorithm>
#include <stdexcept>

#include "sessions/files/input_error.h"
#include "sessions/files/nearest_name.h"
#include "sessions/text/plain_values.h"

namespace herr {
namespace {

constexpr const char* kOff = "off";
constexpr const char* kOn = "on";

std::string number_text(double value, int step) {
  return step > 0 ? std::to_string(static_cast<std::int64_t>(value)) : plain_number_text(value);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

[[noreturn]] void refuse(const std::string& text, const std::string& wanted) {
  throw std::invalid_argument("'" + printable(text) + "' is not " + wanted);
}

bool fits(const NumberSetting& number, double value) {
  if (!(value >= number.lowest && value <= number.highest)) return false;
  if (number.step == 0) return true;
  const auto whole_value = static_cast<std::int64_t>(value);
  return static_cast<double>(whole_value) == value && whole_value % number.step == 0;
}

double number_from(const NumberSetting& number, const std::string& text) {
  if (number.step == 0) return real_number_from(text, number.lowest, number.highest);
  const auto value = static_cast<double>(whole_number_from(text, static_cast<std::int64_t>(number.lowest),
                                                           static_cast<std::int64_t>(number.highest)));
  if (!fits(number, value)) refuse(text, "a multiple of " + std::to_string(number.step));
  return value;
}

// The width is that of both eyes; rows come in pairs.
void set_size(const SizeSetting& size, const std::string& text) {
  if (size.follows != nullptr && text == size.following) {
    *size.follows = true;
    *size.width_per_eye = size.following_per_eye;
    *size.height = size.following_height;
    return;
  }
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) {
    const std::string word = size.follows != nullptr ? ", or " + size.following : "";
    refuse(text, "a size; write WIDTHxHEIGHT, for example 1576x768" + word);
  }
  const std::int64_t width =
      whole_number_from(text.substr(0, cross), 1, 2 * std::int64_t{size.widest_per_eye});
  const std::int64_t height = whole_number_from(text.substr(cross + 1), 1, size.highest);
  if (width % 2 != 0 || height % 2 != 0) {
    refuse(text, "a size of even numbers (the width is both eyes together); write for example 1576x768");
  }
  *size.width_per_eye = static_cast<int>(width / 2);
  *size.height = static_cast<int>(height);
  if (size.follows != nullptr) *size.follows = false;
}

// In the words of check_range().
[[noreturn]] void refuse_value(const Setting& setting, const std::string& wanted, const std::string& found) {
  throw std::invalid_argument(label_of(setting) + " must " + wanted + ", not " + found);
}

void check_between(const std::string& label, int value, int lowest, int highest) {
  if (value >= lowest && value <= highest) return;
  throw std::invalid_argument(label + " must lie in [" + std::to_string(lowest) + ", " +
                              std::to_string(highest) + "], not " + std::to_string(value));
}

}  // namespace

bool is_switch(const Setting& setting) {
  const auto* word = std::get_if<WordSetting>(&setting.value);
  return word != nullptr && word->words == std::vector<std::string>{kOff, kOn};
}

bool is_idle(const Setting& setting) {
  return setting.idle_beside && !setting.idle_beside().empty();
}

std::vector<std::string> idle_settings(const std::vector<Setting>& settings,
                                       const std::vector<Setting>& defaults) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const Setting& setting = settings[i];
    const std::string text = text_of(setting);
    if (!is_idle(setting) || text == text_of(defaults.at(i))) continue;
    lines.push_back(setting.flag + (is_switch(setting) ? "" : " " + text) + ": no effect with " +
                    setting.idle_beside());
  }
  return lines;
}

bool shapes_pictures(const Setting& setting) {
  return setting.effect != SettingEffect::none;
}

std::string label_of(const Setting& setting) {
  std::string label = setting.name;
  if (!setting.unit.empty() && label.ends_with("_" + setting.unit)) {
    label.resize(label.size() - setting.unit.size() - 1);
  }
  std::replace(label.begin(), label.end(), '_', ' ');
  return label;
}

std::string text_of(const Setting& setting) {
  if (const auto* number = std::get_if<NumberSetting>(&setting.value)) {
    const std::optional<double> value = number->get();
    return value ? number_text(*value, number->step) : "";
  }
  if (const auto* word = std::get_if<WordSetting>(&setting.value)) return word->words.at(word->get());
  if (const auto* size = std::get_if<SizeSetting>(&setting.value)) {
    if (size->follows != nullptr && *size->follows) return size->following;
    return std::to_string(2 * *size->width_per_eye) + "x" + std::to_string(*size->height);
  }
  return std::get<TextSetting>(setting.value).get();
}

PlainValue value_of(const Setting& setting) {
  if (const auto* number = std::get_if<NumberSetting>(&setting.value)) {
    const std::optional<double> value = number->get();
    if (!value) return std::monostate();
    if (number->step == 0) return *value;
    return static_cast<std::int64_t>(*value);
  }
  if (is_switch(setting)) return std::get<WordSetting>(setting.value).get() == 1;
  const std::string text = text_of(setting);
  if (text.empty()) return std::monostate();
  return text;
}

void set_text(const Setting& setting, const std::string& text) {
  if (const auto* number = std::get_if<NumberSetting>(&setting.value)) {
    number->set(number_from(*number, text));
  } else if (const auto* word = std::get_if<WordSetting>(&setting.value)) {
    word->set(word_from(text, word->words));
  } else if (const auto* size = std::get_if<SizeSetting>(&setting.value)) {
    set_size(*size, text);
  } else {
    std::get<TextSetting>(setting.value).set(text);
  }
}

void set_value(const Setting& setting, const PlainValue& value) {
  const auto* number = std::get_if<NumberSetting>(&setting.value);
  const auto* whole_value = std::get_if<std::int64_t>(&value);
  const auto* real_value = std::get_if<double>(&value);
  const auto* text = std::get_if<std::string>(&value);
  const auto* on = std::get_if<bool>(&value);
  if (number != nullptr && (whole_value != nullptr || real_value != nullptr)) {
    const double wanted = whole_value != nullptr ? static_cast<double>(*whole_value) : *real_value;
    if (!fits(*number, wanted)) refuse(number_text(wanted, 0), "within " + range_text(setting));
    number->set(wanted);
  } else if (number != nullptr && number->optional && std::holds_alternative<std::monostate>(value)) {
    number->set(std::nullopt);
  } else if (is_switch(setting) && on != nullptr) {
    std::get<WordSetting>(setting.value).set(*on ? 1 : 0);
  } else if (number == nullptr && !is_switch(setting) && text != nullptr) {
    set_text(setting, *text);
  } else {
    throw std::invalid_argument("the value is of another type");
  }
}

void check_range(const Setting& setting) {
  const std::string label = label_of(setting);
  if (const auto* number = std::get_if<NumberSetting>(&setting.value)) {
    const std::optional<double> value = number->get();
    if (!value || fits(*number, *value)) return;
    const std::string unit = setting.unit.empty() ? "" : " " + setting.unit;
    refuse_value(
        setting,
        (number->step > 1 ? "be a multiple of " + std::to_string(number->step) + " in [" : "lie in [") +
            number_text(number->lowest, number->step) + ", " + number_text(number->highest, number->step) +
            "]" + unit,
        number_text(*value, number->step));
  }
  if (const auto* size = std::get_if<SizeSetting>(&setting.value)) {
    check_between(label + " width", *size->width_per_eye, 1, size->widest_per_eye);
    check_between(label + " height", *size->height, 2, size->highest);
    if (*size->height % 2 != 0) throw std::invalid_argument(label + " height must be even");
  }
}

std::string range_text(const Setting& setting) {
  if (const auto* number = std::get_if<NumberSetting>(&setting.value)) {
    return number_text(number->lowest, number->step) + " ... " + number_text(number->highest, number->step);
  }
  if (const auto* word = std::get_if<WordSetting>(&setting.value)) return joined(word->words);
  if (const auto* size = std::get_if<SizeSetting>(&setting.value)) {
    const std::string word = size->follows != nullptr ? ", " + size->following : "";
    return "2x2 ... " + std::to_string(2 * size->widest_per_eye) + "x" + std::to_string(size->highest) + word;
  }
  return "";
}

std::string other_text(const Setting& setting) {
  if (const auto* number = std::get_if<NumberSetting>(&setting.value)) {
    const double other = number->get() == number->lowest ? number->highest : number->lowest;
    return number_text(other, number->step);
  }
  if (const auto* word = std::get_if<WordSetting>(&setting.value)) {
    return word->words[(word->get() + 1) % word->words.size()];
  }
  if (const auto* size = std::get_if<SizeSetting>(&setting.value)) {
    return *size->height == 2 ? "2x4" : "2x2";
  }
  return std::get<TextSetting>(setting.value).example;
}

const Setting& setting_named(const std::vector<Setting>& settings, const std::string& name) {
  std::vector<std::string> names;
  for (const Setting& setting : settings) {
    if (setting.name == name) return setting;
    names.push_back(setting.name);
  }
  const std::string nearest = nearest_name(name, names);
  throw std::invalid_argument("'" + printable(name) + "' is no setting" +
                              (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
}

NumberSetting whole_or_zero(int& value, double lowest, double highest) {
  return {[&value]() -> std::optional<double> {
            if (value == 0) return std::nullopt;
            return value;
          },
          [&value](std::optional<double> number) { value = static_cast<int>(number.value_or(0)); },
          lowest,
          highest,
          1,
          true};
}

WordSetting on_off(bool& value) {
  return one_of(value, {kOff, kOn});
}

}  // namespace herr
