#include "sessions/import/check/proposed_map.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "sessions/files/input_error.h"
#include "sessions/import/check/axis_conventions.h"
#include "sessions/import/check/column_roles.h"
#include "sessions/import/check/sniffed_table.h"
#include "sessions/import/presets/choose_format.h"
#include "sessions/import/presets/trial_import.h"

namespace herr {
namespace {

constexpr double kLevel = 0.8;  // of the rows: people seldom lie on their side
// Of the way: people walk forwards.
constexpr double kForwards = 0.7;
constexpr double kGazeAheadDeg = 40;  // people's eyes rest within it
constexpr double kTallestM = 3;       // median |position| of a head in a room, roughly

ColumnGroup group_of(const SniffedTable& table, const std::vector<std::size_t>& columns) {
  ColumnGroup group;
  group.numbers = columns.size();
  for (const std::size_t column : columns) group.columns.push_back(table.ref(column));
  return group;
}

std::optional<double> median(const SniffedTable& table, std::size_t column) {
  auto values = table.numbers(column);
  if (!values) return std::nullopt;
  std::erase_if(*values, [](double value) { return !std::isfinite(value); });
  if (values->empty()) return std::nullopt;
  const auto middle = values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2);
  std::nth_element(values->begin(), middle, values->end());
  return std::abs(*middle);
}

// Heads are 1 to 2 m above something: hundreds are centimetres, thousands millimetres.
std::pair<double, const char*> length_unit(const SniffedTable& table,
                                           const std::vector<std::size_t>& columns) {
  double most = 0;
  for (const std::size_t column : columns) most = std::max(most, median(table, column).value_or(0));
  if (most > 100 * kTallestM) return {0.001, "mm"};
  if (most > 10 * kTallestM) return {0.01, "cm"};
  return {1, "m"};
}

HeadColumns head_columns(const SniffedTable& table, const TimeRole& time, const RotationRole& rotation,
                         std::vector<std::string>& reasons) {
  HeadColumns head;
  head.table = table.format;
  head.time = time.time;
  head.rotation_kind = rotation.kind;
  head.rotation = group_of(table, rotation.columns);
  head.radians_per_unit = rotation.radians_per_unit;
  if (rotation.kind == RotationKind::euler_xyz) head.euler_order = rotation.unreal_names ? "xyz" : "zxy";
  if (rotation.unreal_names) head.euler_sense = {-1, -1, 1};
  if (rotation.kind == RotationKind::matrix_4x4) return head;
  std::size_t time_column = table.columns();
  for (std::size_t column = 0; column < table.columns(); ++column) {
    const ColumnRef ref = table.ref(column);
    if (ref.name == time.time.column.name && ref.number == time.time.column.number) time_column = column;
  }
  if (const auto position = find_position(table, rotation, time_column)) {
    head.position = group_of(table, position->columns);
    const auto [scale, word] = length_unit(table, position->columns);
    head.metres_per_unit = scale;
    reasons.push_back(position->reason + ", in " + word);
  }
  return head;
}

std::optional<GazeColumns> gaze_columns(const SniffedTable& table, bool in_head_file,
                                        std::vector<std::string>& reasons) {
  const auto role = find_gaze(table);
  const auto time = find_time(table);
  if (!role || !time) return std::nullopt;
  GazeColumns gaze;
  gaze.in_head_file = in_head_file;
  gaze.table = table.format;
  gaze.time = time->time;
  for (const auto& columns : role->rays) {
    DirectionColumns ray;
    ray.vector = group_of(table, columns);
    gaze.rays.push_back(std::move(ray));
  }
  reasons.push_back(role->reason);
  return gaze;
}

struct Candidate {
  const AxisConvention* axes = nullptr;
  std::shared_ptr<const ColumnMap> map;
  TrialImport trial;
};

Candidate try_axes(const RecordingFiles& files, ColumnMap map, const AxisConvention& axes) {
  HeadColumns& head = map.head.front();
  head.world_axes = directions(axes.world);
  head.head_axes = directions(axes.head);
  for (GazeColumns& gaze : map.gaze) gaze.axes = head.head_axes;
  Candidate candidate;
  candidate.axes = &axes;
  candidate.map = std::make_shared<const ColumnMap>(std::move(map));
  FormatRequest request;
  request.files = files;
  const GazeColumns* gaze = candidate.map->gaze.empty() ? nullptr : &candidate.map->gaze.front();
  const ImportRequest import = import_request(request, {&candidate.map->head.front(), gaze});
  candidate.trial = trial_import(import);
  return candidate;
}

bool excluded(const Candidate& candidate) {
  if (!implausible(candidate.trial).empty()) return true;
  const PlausibilityFigures& f = candidate.trial.figures;
  return (f.level_share && *f.level_share < kLevel) ||
         (f.forwards_share && *f.forwards_share < 1 - kForwards);
}

// What speaks for these axes beyond being level: walking ahead, eyes that rest ahead.
int evidence(const Candidate& candidate, std::vector<std::string>& reasons) {
  int found = 0;
  if (candidate.trial.figures.forwards_share.value_or(0) > kForwards) {
    reasons.push_back("the head looks where it walks");
    ++found;
  }
  const PlausibilityFigures& f = candidate.trial.figures;
  if (f.gaze_rows > 0 && f.median_gaze_deg > 0 && f.median_gaze_deg < kGazeAheadDeg) {
    reasons.push_back("the eyes rest ahead of the head");
    ++found;
  }
  if (eye_evidence(candidate.trial) > kChanceEvidence) {
    reasons.push_back("the eyes turn against the head, as people's do");
    ++found;
  }
  return found;
}

const AxisConvention& named_axes(bool unreal) {
  return axis_conventions()[unreal ? 3 : 0];
}

}  // namespace

ProposedMap propose_map(const RecordingFiles& files) {
  ProposedMap proposed;
  const std::optional<SniffedTable> table = sniff_table(files.head);
  if (!table) {
    proposed.questions.push_back("what the file is: it is no table of separated fields");
    return proposed;
  }
  const auto time = find_time(*table);
  const std::vector<RotationRole> rotations = find_rotations(*table);
  if (!time)
    proposed.questions.push_back(
        "where the time stands: no column grows like a clock (\"time\" of a map; "
        "\"rate_hz\" where none was written)");
  else
    proposed.reasons.push_back(time->reason);
  if (rotations.empty())
    proposed.questions.push_back(
        "where the head's rotation stands: no columns are a unit quaternion, a matrix or "
        "angles by their names (\"orientation\" of a map)");
  if (!time || rotations.empty()) return proposed;

  const RotationRole& first = rotations.front();
  const bool angles = first.kind == RotationKind::euler_xyz;
  std::vector<Candidate> candidates;
  for (const RotationRole& rotation : rotations) {
    if (rotation.kind != first.kind && !table->names.empty())
      break;  // a quaternion wins over angles beside it
    std::vector<std::string> reasons{rotation.reason};
    ColumnMap map;
    map.name = files.head.stem().string();
    map.note = "proposed from the data of " + files.head.filename().string();
    map.head.push_back(head_columns(*table, *time, rotation, reasons));
    const std::optional<SniffedTable> gaze_table = files.gaze ? sniff_table(*files.gaze) : table;
    if (gaze_table)
      if (auto gaze = gaze_columns(*gaze_table, !files.gaze, reasons)) map.gaze.push_back(std::move(*gaze));
    if (candidates.empty()) proposed.reasons.insert(proposed.reasons.end(), reasons.begin(), reasons.end());
    if (angles) {  // names of angles belong to an engine
      candidates.push_back(try_axes(files, std::move(map), named_axes(rotation.unreal_names)));
      break;
    }
    for (const AxisConvention& axes : axis_conventions()) candidates.push_back(try_axes(files, map, axes));
  }
  std::erase_if(candidates, excluded);
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    std::vector<std::string> unused;
    return evidence(a, unused) > evidence(b, unused);
  });
  std::vector<std::string> unused;
  const int best = candidates.empty() ? 0 : evidence(candidates.front(), unused);
  const int second = candidates.size() < 2 ? -1 : evidence(candidates[1], unused);
  if (candidates.empty() || (best == second && !angles) || (best == 0 && !angles)) {
    proposed.questions.push_back(
        candidates.empty()
            ? "where the axes point: with none of the usual ones the head is level"
            : "where the axes point: the data fit " + std::to_string(candidates.size()) +
                  " conventions, among them " + candidates.front().axes->name + " and " +
                  candidates.back().axes->name + " (\"world_axes\" and \"head_axes\" of a map)");
    return proposed;
  }
  evidence(candidates.front(), proposed.reasons);
  proposed.reasons.push_back("with the axes of " + std::string(candidates.front().axes->name) + " the head " +
                             candidates.front().trial.words);
  proposed.map = *candidates.front().map;
  return proposed;
}

}  // namespace herr
