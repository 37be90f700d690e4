// events.jsonl: one JSON object a line, each with its t_ns; what it means is for scenes/ to say.
// Before: LineReader. After: Session::events_until. Unlike samples, several events may share one stamp.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "sessions/files/line_reader.h"
#include "sessions/streams/row_stream.h"
#include "sessions/streams/scene_event.h"

namespace herr {

class EventStream {
 public:
  EventStream(const std::filesystem::path& file, RowPolicy policy);
  // The next good event, or none at the end. Throws InputError.
  std::optional<SceneEvent> next();
  // After the end: what the last line held when the file ends in the middle of it, else empty.
  const std::string& cut_off() const { return cut_off_; }
  std::int64_t line() const { return line_; }
  const std::filesystem::path& path() const { return reader_.path(); }

 private:
  SceneEvent parse(const TextLine& line) const;

  LineReader reader_;
  RowPolicy policy_;
  TimeNs last_ns_ = 0;
  std::int64_t line_ = 0;
  std::string cut_off_;
};

}  // namespace herr
