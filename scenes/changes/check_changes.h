// Whether changes can be made, found out before the first frame: a dry run over names and placements alone.
// Before: load_scene, a session's events. After: errors and counts; no scene is touched.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "scenes/model/scene.h"
#include "sessions/files/input_error.h"
#include "sessions/format/pose.h"

namespace herr {

// The document's timeline by itself. Throws InputError for the first entry that cannot be applied.
void check_timeline(const Scene& scene);

// Plays a session's events and the timeline together. Memory does not grow with their number.
class ChangeRehearsal {
 public:
  explicit ChangeRehearsal(const Scene& scene);
  ~ChangeRehearsal();
  // A line of events.jsonl, in the order of the file. Throws InputError for one that cannot be applied, also
  // of the timeline; it is then left out.
  void play(const std::string& json, const std::filesystem::path& file, std::int64_t line, TimeNs start_ns);
  // What is left of the timeline after the last event.
  void finish();
  // About quaternions of the events that look w-first (order_doubt()), with the line of the first; none: none
  // does.
  std::optional<InputError> w_first_warning() const;
  // Changes of each kind that could be made, in the order of ChangeKind; the timeline's are not among them.
  const std::array<std::int64_t, 6>& counts() const;

 private:
  struct Stage;
  std::unique_ptr<Stage> stage_;
};

}  // namespace herr
