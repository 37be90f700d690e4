#include "sessions/import/check/described_columns.h"

#include "sessions/import/map/map_words.h"

namespace herr {
namespace {

std::string called(const ColumnRef& column) {
  return column.number > 0 ? "column " + std::to_string(column.number) : "'" + column.name + "'";
}

std::string called(const ColumnGroup& group) {
  if (group.columns.empty()) return "";
  if (group.columns.size() == 1) return called(group.columns.front());
  return called(group.columns.front()) + " to " + called(group.columns.back());
}

std::string time_text(const TimeColumns& time) {
  switch (time.kind) {
    case TimeColumns::Kind::number:
      return "The time stands in " + called(time.column) + ", in " + word_of(time.unit) + ".";
    case TimeColumns::Kind::seconds_nanoseconds:
      return "The time stands in " + called(time.column) + " (s) and " + called(time.nanoseconds) + " (ns).";
    case TimeColumns::Kind::date:
      return "The time stands in " + called(time.column) + ", as dates.";
    case TimeColumns::Kind::rate:
      return "No time was recorded.";
  }
  return "";
}

std::string axes_text_of(const AxisDirections& axes) {
  const auto words = axes.words();
  return words[0] + ", " + words[1] + ", " + words[2];
}

const char* rotation_word(RotationKind kind) {
  for (const RotationWord& word : kRotationWords)
    if (word.meaning == kind) return word.word;
  return "";
}

void describe_head(const HeadColumns& head, std::vector<std::string>& text) {
  text.push_back(time_text(head.time));
  if (head.position)
    text.push_back("The position stands in " + called(*head.position) + ", in " +
                   word_of(kLengthWords, head.metres_per_unit) + ".");
  if (head.rotation_kind == RotationKind::fixed) {
    text.push_back("The head was not recorded and stands still.");
    return;
  }
  text.push_back("The rotation stands in " + called(head.rotation) + " (" +
                 rotation_word(head.rotation_kind) + ").");
  text.push_back("The world's x, y and z point " + axes_text_of(head.world_axes) + ", the head's " +
                 axes_text_of(head.head_axes) + ".");
}

void describe_gaze(const GazeColumns& gaze, bool own_time, std::vector<std::string>& text) {
  const DirectionColumns& ray = gaze.rays.front();
  const std::optional<ColumnGroup>& group = ray.vector     ? ray.vector
                                            : ray.tangents ? ray.tangents
                                            : ray.angles   ? ray.angles
                                                           : ray.point;
  const char* what = ray.vector     ? "a vector"
                     : ray.tangents ? "two tangents"
                     : ray.angles   ? "two angles"
                                    : "a point";
  if (own_time) text.push_back("Of the gaze: " + time_text(gaze.time));
  text.push_back(std::string("The gaze is ") + (gaze.rays.size() > 1 ? "that of each eye, " : "combined, ") +
                 what + " in " + (group ? called(*group) : "") + "; its x, y and z point " +
                 axes_text_of(gaze.axes) + " in the " +
                 (gaze.space == GazeSpace::world ? "world." : "head."));
}

}  // namespace

std::vector<std::string> described(const ImportColumns& columns) {
  std::vector<std::string> text;
  if (columns.head != nullptr) describe_head(*columns.head, text);
  if (columns.gaze != nullptr)
    describe_gaze(*columns.gaze, columns.head == nullptr || !(columns.head->time == columns.gaze->time),
                  text);
  return text;
}

}  // namespace herr
