#include "sessions/import/presets/choose_format.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <utility>

#include "sessions/files/input_error.h"
#include "sessions/import/presets/built_in_maps.h"
#include "sessions/import/presets/format_fit.h"
#include "sessions/import/presets/format_trial.h"
#include "sessions/import/rows/gaze_reader.h"
#include "sessions/import/rows/head_reader.h"
#include "sessions/text/plain_values.h"

namespace herr {
namespace {

constexpr std::int64_t kFirstRows = 200;  // can be read at all
constexpr std::int64_t kTrialRows = 20000;

const std::filesystem::path& shown_file(const RecordingFiles& files) {
  return files.head.empty() && files.gaze ? *files.gaze : files.head;
}

std::string name_of(const FormatCandidate& candidate, bool with_preset) {
  const std::string& preset = candidate.preset;
  if (candidate.variant.empty()) return preset;
  return with_preset ? preset + " " + candidate.variant : candidate.variant;
}

std::string names_of(const std::vector<FormatTrial>& trials, bool with_preset) {
  std::string text;
  for (const FormatTrial& trial : trials)
    if (!trial.error) text += (text.empty() ? "" : ", ") + name_of(trial.candidate, with_preset);
  return text;
}

ChosenFormat chosen(const FormatCandidate& candidate) {
  ChosenFormat format;
  format.map = candidate.map;
  format.preset = candidate.preset;
  format.columns = candidate.columns;
  format.variant = candidate.variant;
  return format;
}

// Takes the one that the data speak for.
ChosenFormat told_apart(const RecordingFiles& files, const std::vector<FormatCandidate>& candidates) {
  if (candidates.size() == 1) return chosen(candidates.front());
  const bool siblings =
      std::all_of(candidates.begin(), candidates.end(),
                  [&](const FormatCandidate& candidate) { return candidate.map == candidates.front().map; });
  std::vector<FormatTrial> trials;
  for (const std::int64_t most_rows : {kTrialRows, std::int64_t{0}}) {
    trials.clear();
    for (const FormatCandidate& candidate : candidates)
      trials.push_back(try_format(files, candidate, most_rows));
    const FormatTrial* best = best_of(trials);
    if (best == nullptr) continue;
    ChosenFormat format = chosen(best->candidate);
    for (const FormatTrial& other : trials)
      if (&other != best)
        format.remarks.push_back((siblings ? "variant " : "preset ") + name_of(best->candidate, !siblings) +
                                 " was taken and not " + name_of(other.candidate, !siblings) + ": " +
                                 better_because(*best, other));
    return format;
  }
  if (siblings)
    throw InputError(shown_file(files), 0,
                     "fits several variants of '" + candidates.front().map->name +
                         "', and the data cannot tell which: " + names_of(trials, false),
                     "give --variant NAME");
  throw InputError(shown_file(files), 0,
                   "fits several presets, and the data cannot tell which: " + names_of(trials, true),
                   "give --preset NAME, and --variant NAME where one is named");
}

// "*" stands for any text.
bool matches(const std::string& pattern, const std::string& name) {
  const std::size_t star = pattern.find('*');
  if (star == std::string::npos) return pattern == name;
  const std::string head = pattern.substr(0, star), tail = pattern.substr(star + 1);
  return name.size() >= head.size() + tail.size() && name.starts_with(head) && name.ends_with(tail);
}

bool has_name_of_layout(const RecordingFiles& files, const ColumnMap& map) {
  const std::string name = shown_file(files).filename().string();
  return std::any_of(map.layouts.begin(), map.layouts.end(), [&](const RecordingLayout& layout) {
    for (const std::string& path : {layout.head, layout.gaze}) {
      const std::string pattern = std::filesystem::path(path).filename().string();
      if (pattern.find_first_not_of('*') != std::string::npos && matches(pattern, name)) return true;
    }
    return false;
  });
}

// How much speaks for a format before a row is judged: named columns, the file's name, gaze, how many
// columns.
using FormatRank = std::tuple<bool, bool, bool, std::size_t>;

FormatRank rank_of(const RecordingFiles& files, const FormatCandidate& candidate) {
  std::vector<ColumnRef> columns;
  if (candidate.columns.head != nullptr) columns = columns_of(*candidate.columns.head);
  if (candidate.columns.gaze != nullptr)
    for (const ColumnRef& column : columns_of(*candidate.columns.gaze)) columns.push_back(column);
  std::vector<ColumnRef> different;
  for (const ColumnRef& column : columns)
    if (std::find(different.begin(), different.end(), column) == different.end()) different.push_back(column);
  const bool named = std::any_of(different.begin(), different.end(),
                                 [](const ColumnRef& column) { return column.number == 0; });
  return {named, has_name_of_layout(files, *candidate.map), candidate.columns.gaze != nullptr,
          different.size()};
}

ChosenFormat choose_built_in(const RecordingFiles& files, const StillParts& still) {
  std::vector<FormatCandidate> best;
  FormatRank highest{};
  for (const BuiltInMap& built_in : built_in_maps()) {
    const auto map = std::make_shared<const ColumnMap>(
        parse_column_map(built_in.json, std::string(built_in.name) + ".json"));
    std::vector<FormatCandidate> candidates;
    try {
      candidates = fitting_formats(files, map, "", still);
    } catch (const InputError&) {
      continue;  // of another program
    }
    for (FormatCandidate& candidate : candidates) {
      candidate.preset = built_in.name;
      const FormatRank rank = rank_of(files, candidate);
      if (!best.empty() && rank < highest) continue;
      if (try_format(files, candidate, kFirstRows).error) continue;
      if (rank > highest) best.clear();
      highest = rank;
      best.push_back(std::move(candidate));
    }
  }
  if (best.empty())
    throw InputError(shown_file(files), 0, "fits none of the built-in formats",
                     "look at it with herr convert --check FILE, or give --preset or --map");
  ChosenFormat format = told_apart(files, best);
  format.remarks.insert(format.remarks.begin(), "it is read as --preset " + format.preset);
  return format;
}

}  // namespace

ChosenFormat choose_format(const RecordingFiles& files, const std::string& preset,
                           std::shared_ptr<const ColumnMap> map, const std::string& variant,
                           const StillParts& still) {
  if (preset.empty() && map == nullptr) return choose_built_in(files, still);
  if (map == nullptr) {
    const BuiltInMap& built_in = built_in_maps()[word_from(preset, built_in_map_names())];
    map = std::make_shared<const ColumnMap>(
        parse_column_map(built_in.json, std::string(built_in.name) + ".json"));
  }
  std::vector<FormatCandidate> candidates = fitting_formats(files, map, variant, still);
  for (FormatCandidate& candidate : candidates) candidate.preset = preset;
  return told_apart(files, candidates);
}

}  // namespace herr
