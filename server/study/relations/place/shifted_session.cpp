#include "server/study/relations/place/shifted_session.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/line_reader.h"
#include "sessions/files/write_error.h"

namespace herr {
namespace {

using JsonValue = nlohmann::ordered_json;

constexpr std::size_t kLongestLine = 1 << 20;
constexpr const char* kRowFiles[] = {"pose/data.csv", "gaze/data.csv"};
constexpr const char* kEventFile = "events.jsonl";
constexpr const char* kHeaderFile = "session.json";

// Takes each stamp that it is shown, and says what stands in its place.
class Stamps {
 public:
  explicit Stamps(TimeNs shift_ns) : shift_ns_(shift_ns) {}
  TimeNs operator()(TimeNs stamp_ns) {
    first_ns_ = std::min(first_ns_, stamp_ns), last_ns_ = std::max(last_ns_, stamp_ns);
    return stamp_ns + shift_ns_;
  }
  StampSpan span() const { return {first_ns_, last_ns_}; }

 private:
  TimeNs shift_ns_;
  TimeNs first_ns_ = std::numeric_limits<TimeNs>::max(), last_ns_ = 0;
};

std::string_view field_of(std::string_view line, std::size_t index, std::size_t& begin) {
  begin = 0;
  for (; index > 0; --index) {
    const std::size_t comma = line.find(',', begin);
    if (comma == std::string_view::npos) return {};
    begin = comma + 1;
  }
  return line.substr(begin, line.find(',', begin) - begin);
}

std::optional<std::size_t> stamp_column(std::string_view header) {
  std::size_t begin = 0;
  for (std::size_t index = 0; index <= std::size_t{64}; ++index) {
    const std::string_view name = field_of(header, index, begin);
    if (name == "timestamp_ns") return index;
  }
  return std::nullopt;
}

// Rows whose stamp is none stay as they are: the reader says what it thinks of them.
std::string shifted_row(std::string_view row, std::size_t column, Stamps& stamps) {
  std::size_t begin = 0;
  const std::string_view field = field_of(row, column, begin);
  TimeNs stamp_ns = 0;
  const auto read = std::from_chars(field.data(), field.data() + field.size(), stamp_ns);
  std::string text(row);
  if (field.empty() || read.ec != std::errc() || read.ptr != field.data() + field.size()) return text;
  return text.replace(begin, field.size(), std::to_string(stamps(stamp_ns)));
}

std::string shifted_rows(const std::filesystem::path& file, Stamps& stamps) {
  LineReader reader(file, kLongestLine);
  std::string text;
  std::optional<std::size_t> column;
  TextLine line;
  for (std::int64_t row = 0; row <= kShiftedRows && reader.next(line) && line.whole; ++row) {
    if (row == 0) column = stamp_column(line.text);
    text += row > 0 && column ? shifted_row(line.text, *column, stamps) : std::string(line.text);
    text += '\n';
  }
  return text;
}

void shift_field(JsonValue& object, const char* name, Stamps& stamps) {
  if (!object.is_object() || !object.contains(name) || !object[name].is_number_integer()) return;
  object[name] = stamps(object[name].get<TimeNs>());
}

std::string shifted_events(const std::filesystem::path& file, Stamps& stamps) {
  LineReader reader(file, kLongestLine);
  std::string text;
  TextLine line;
  for (std::int64_t row = 0; row < kShiftedRows && reader.next(line) && line.whole; ++row) {
    JsonValue event = JsonValue::parse(line.text, nullptr, false);
    shift_field(event, "t_ns", stamps);
    text += (event.is_discarded() ? std::string(line.text) : event.dump()) + '\n';
  }
  return text;
}

std::string shifted_header(const std::filesystem::path& file, Stamps& stamps) {
  LineReader reader(file, kLongestLine);
  std::string text;
  for (TextLine line; reader.next(line);) text += std::string(line.text) + '\n';
  JsonValue header = JsonValue::parse(text, nullptr, false);
  if (header.is_discarded()) return text;
  for (const char* name : {"start_ns", "end_ns"}) shift_field(header, name, stamps);
  header.erase("cameras");
  return header.dump(1);
}

// Hands on the text of every file of the copy.
template <typename Take>
void copy_session(const std::filesystem::path& session, Stamps& stamps, const Take& take) {
  take(kHeaderFile, shifted_header(session / kHeaderFile, stamps));
  for (const char* name : kRowFiles) {
    if (is_file(session / name)) take(name, shifted_rows(session / name, stamps));
  }
  if (is_file(session / kEventFile)) take(kEventFile, shifted_events(session / kEventFile, stamps));
}

}  // namespace

StampSpan stamps_of(const std::filesystem::path& session) {
  Stamps stamps(0);
  copy_session(session, stamps, [](const char*, const std::string&) {});
  return stamps.span();
}

ShiftedSession::ShiftedSession(const std::filesystem::path& session, TimeNs shift_ns) {
  Stamps stamps(shift_ns);
  copy_session(session, stamps, [this](const char* name, const std::string& text) {
    const std::filesystem::path file = folder() / name;
    if (const std::error_code error = make_folders(file.parent_path()))
      throw WriteError(file.parent_path(), "make the folder", error.value());
    write_whole_file(file, text);
  });
}

}  // namespace herr
