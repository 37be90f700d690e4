#include "sessions/streams/event_stream.h"

#include <utility>

#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"
#include "sessions/format/session_header.h"

namespace herr {
namespace {
constexpr std::size_t kMaxEventBytes = 1 << 20;  // an event names an object and a few numbers
}

EventStream::EventStream(const std::filesystem::path& file, RowPolicy policy)
    : reader_(file, kMaxEventBytes), policy_(std::move(policy)) {}

SceneEvent EventStream::parse(const TextLine& line) const {
  if (line.too_long) throw InputError(path(), line.number, "the line is longer than 1 MiB", "remove it");
  const JsonDocument document(line.text, path(), line.number);
  if (!document.is_object())
    throw InputError(path(), line.number, "is not an object", "write {\"t_ns\": ..., \"op\": ...}");
  SceneEvent event{0, std::string(line.text), line.number};
  event.t_ns = document.root().integer("t_ns", 0, kLastStampNs);
  if (event.t_ns < last_ns_)
    throw InputError(path(), line.number,
                     "t_ns " + std::to_string(event.t_ns) + " goes backwards by " +
                         std::to_string(last_ns_ - event.t_ns) + " ns",
                     "sort the events by time");
  return event;
}

std::optional<SceneEvent> EventStream::next() {
  TextLine line;
  while (reader_.next(line)) {
    line_ = line.number;
    if (!line.whole) {
      cut_off_ = std::string(line.text);
      return std::nullopt;
    }
    try {
      SceneEvent event = parse(line);
      last_ns_ = event.t_ns;
      return event;
    } catch (const InputError& error) {
      if (!policy_.keep_going) throw;
      if (policy_.on_skipped) policy_.on_skipped(error);
    }
  }
  return std::nullopt;
}

}  // namespace herr
