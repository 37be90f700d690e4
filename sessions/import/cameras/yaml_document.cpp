#include "sessions/import/cameras/yaml_document.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"

namespace herr {
namespace {

constexpr std::int64_t kMostYamlBytes = 256 << 10;
constexpr std::size_t kDeepestYaml = 16, kMostYamlValues = 20000;

// Builds the document from what the parser meets, so that nothing is built that is not checked.
class YamlBuilder final : public YAML::EventHandler {
 public:
  explicit YamlBuilder(const std::filesystem::path& file) : file_(file) {}

  nlohmann::json take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { add(mark, anchor, nullptr); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { refuse_anchor(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    if (!open_.empty() && open_.back().value.is_object() && !open_.back().key) {
      set_key(mark, anchor, text);
      return;
    }
    add(mark, anchor, tag == "?" ? plain_value(text) : nlohmann::json(text));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, anchor, nlohmann::json::array());
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, anchor, nlohmann::json::object());
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    nlohmann::json value;
    std::optional<std::string> key;  // of the value that comes next
    std::int64_t line = 0;
  };

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& problem) const {
    throw InputError(file_, mark.line + 1, problem, "check that this is the calibration of a camera");
  }
  [[noreturn]] void refuse_anchor(const YAML::Mark& mark) const {
    throw InputError(file_, mark.line + 1, "holds an anchor or alias ('&' or '*')",
                     "write the values out; calibrations need none");
  }

  static nlohmann::json plain_value(const std::string& text) {
    const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* last = text.data() + text.size();
    double number = 0;
    const auto [end, error] = std::from_chars(first, last, number);
    if (error == std::errc() && end == last && std::isfinite(number)) return number;
    return text;
  }

  void count(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != 0) refuse_anchor(mark);
    if (++values_ > kMostYamlValues) fail(mark, "holds more than 20000 values");
  }

  void set_key(const YAML::Mark& mark, YAML::anchor_t anchor, const std::string& text) {
    count(mark, anchor);
    if (open_.back().value.contains(text)) fail(mark, "names '" + printable(text) + "' twice");
    open_.back().key = text;
  }

  void add(const YAML::Mark& mark, YAML::anchor_t anchor, nlohmann::json value) {
    count(mark, anchor);
    place(mark.line + 1, std::move(value));
  }

  void open(const YAML::Mark& mark, YAML::anchor_t anchor, nlohmann::json value) {
    count(mark, anchor);
    if (open_.size() >= kDeepestYaml) fail(mark, "is nested deeper than 16");
    open_.push_back({std::move(value), {}, mark.line + 1});
  }

  void close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    place(done.line, std::move(done.value));
  }

  void place(std::int64_t line, nlohmann::json value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return;
    }
    Open& parent = open_.back();
    if (parent.value.is_array()) {
      parent.value.push_back(std::move(value));
    } else if (parent.key) {
      parent.value[*parent.key] = std::move(value);
      parent.key.reset();
    } else {
      throw InputError(file_, line, "has a key that is no text",
                       "check that this is the calibration of a camera");
    }
  }

  const std::filesystem::path& file_;
  nlohmann::json root_;
  std::vector<Open> open_;
  std::size_t values_ = 0;
};

}  // namespace

nlohmann::json read_yaml_file(const std::filesystem::path& file) {
  std::istringstream text(read_whole_file(file, kMostYamlBytes));
  YamlBuilder builder(file);
  try {
    YAML::Parser parser(text);
    if (!parser.HandleNextDocument(builder))
      throw InputError(file, 0, "holds nothing", "check that this is the calibration of a camera");
  } catch (const YAML::Exception& error) {
    throw InputError(file, error.mark.is_null() ? 0 : error.mark.line + 1,
                     "is no YAML (" + printable(error.msg) + ")",
                     "check that this is the calibration of a camera");
  }
  return builder.take();
}

}  // namespace herr
