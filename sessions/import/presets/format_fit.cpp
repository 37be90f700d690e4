#include "sessions/import/presets/format_fit.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>

#include "sessions/files/input_error.h"
#include "sessions/import/presets/proven_angles.h"
#include "sessions/import/rows/gaze_reader.h"
#include "sessions/import/rows/head_reader.h"
#include "sessions/import/rows/time_reader.h"
#include "sessions/import/tables/row_source.h"

namespace herr {
namespace {

constexpr int kSampleRows = 20;

// How many of its columns a file lacks; none where the file is no such table at all.
template <typename Columns>
std::optional<std::size_t> lacking(const std::filesystem::path& file, const Columns& columns,
                                   std::optional<InputError>& why) {
  try {
    const std::vector<ColumnRef> wanted = columns_of(columns);
    const std::unique_ptr<RowSource> rows = open_rows(file, columns.table, wanted);
    std::size_t missing = 0;
    for (const ColumnRef& column : wanted) missing += rows->has(column) ? 0 : 1;
    return missing;
  } catch (const InputError& error) {
    if (!why) why = error;
    return std::nullopt;
  }
}

template <typename Columns>
std::vector<const Columns*> fitting(const std::filesystem::path& file,
                                    const std::vector<Columns>& alternatives) {
  std::vector<const Columns*> found;
  std::optional<InputError> why;
  for (const Columns& columns : alternatives)
    if (lacking(file, columns, why) == std::size_t{0}) found.push_back(&columns);
  return found;
}

// Throws what the alternative lacks that lacks least.
template <typename Columns>
[[noreturn]] void fail_lacking(const std::filesystem::path& file, const ColumnMap& map,
                               const std::vector<const Columns*>& alternatives) {
  std::optional<InputError> why;
  const Columns* nearest = nullptr;
  std::size_t least = 0;
  for (const Columns* columns : alternatives) {
    const auto missing = lacking(file, *columns, why);
    if (!missing || (nearest != nullptr && *missing >= least)) continue;
    nearest = columns;
    least = *missing;
  }
  if (nearest == nullptr && why) throw *why;
  if (nearest != nullptr) {
    const std::vector<ColumnRef> wanted = columns_of(*nearest);
    const std::unique_ptr<RowSource> rows = open_rows(file, nearest->table, wanted);
    for (const ColumnRef& column : wanted) (void)rows->place(column);
  }
  throw InputError(file, 0, "cannot be read by map '" + map.name + "': it says nothing of such a file",
                   "take another preset, or write a map");
}

// Most of the first rows hold what the columns should.
bool reads_first_rows(const std::filesystem::path& file, const HeadColumns& columns) {
  const std::unique_ptr<RowSource> rows = open_rows(file, columns.table, columns_of(columns));
  TimeReader time(*rows, columns.time);
  const HeadReader reader(*rows, columns);
  ReadingCounts counts;
  int good = 0;
  for (int i = 0; i < kSampleRows; ++i) {
    try {
      if (!rows->next()) return 2 * good > i;
      (void)time.read(*rows);
      (void)reader.read(*rows, counts);
      ++good;
    } catch (const InputError&) {
      continue;  // counted by what is missing from good
    }
  }
  return 2 * good > kSampleRows;
}

bool of_variant(const std::string& own, const std::string& wanted) {
  return own.empty() || wanted.empty() || own == wanted;
}

// Of variants that are named, in the order of the map; one empty name where there are none.
std::vector<std::string> variants_of(const ColumnMap& map) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const HeadColumns& head : map.head) add(head.variant);
  for (const GazeColumns& gaze : map.gaze) add(gaze.variant);
  if (names.empty()) names.emplace_back();
  return names;
}

template <typename Columns>
std::vector<const Columns*> usable(const std::vector<Columns>& all, const std::string& variant) {
  std::vector<const Columns*> found;
  for (const Columns& columns : all)
    if (of_variant(columns.variant, variant)) found.push_back(&columns);
  return found;
}

class MapFit {
 public:
  MapFit(const RecordingFiles& files, std::shared_ptr<const ColumnMap> map, const StillParts& still)
      : files_(files), map_(std::move(map)), still_(still) {
    still_.head = still_.head || files_.head.empty();
    if (!still_.head) heads_ = fitting(files_.head, map_->head);
    if (still_.gaze) return;
    const std::filesystem::path& file = files_.gaze.value_or(files_.head);
    if (file.empty()) return;
    for (const GazeColumns* gaze : fitting(file, map_->gaze))
      if (files_.gaze || gaze->in_head_file) gazes_.push_back(gaze);
  }

  // None where head or gaze does not fit.
  std::optional<FormatCandidate> candidate(const std::string& variant) const {
    FormatCandidate found{map_, {}, variant, {}, still_};
    found.columns.head = head_of(variant);
    std::vector<const GazeColumns*> gazes;
    for (const GazeColumns* gaze : gazes_)
      if (of_variant(gaze->variant, variant)) gazes.push_back(gaze);
    if (!gazes.empty()) found.columns.gaze = gazes.front();
    if (gazes.size() > 1)
      if (const GazeColumns* proven = proven_angles(files_.gaze.value_or(files_.head), gazes))
        found.columns.gaze = proven;
    if (found.columns.head == nullptr && !still_.head) return std::nullopt;
    if (found.columns.gaze == nullptr && (still_.head || files_.gaze) && !still_.gaze) return std::nullopt;
    return found;
  }

  [[noreturn]] void fail(const std::string& variant) const {
    if (heads_.empty() && !still_.head) fail_lacking(files_.head, *map_, usable(map_->head, variant));
    fail_lacking(files_.gaze.value_or(files_.head), *map_, usable(map_->gaze, variant));
  }

 private:
  // The first one; columns that go by number are in many files, so that then the first rows decide.
  const HeadColumns* head_of(const std::string& variant) const {
    std::vector<const HeadColumns*> heads;
    for (const HeadColumns* head : heads_)
      if (of_variant(head->variant, variant)) heads.push_back(head);
    if (heads.size() > 1)
      for (const HeadColumns* head : heads)
        if (reads_first_rows(files_.head, *head)) return head;
    return heads.empty() ? nullptr : heads.front();
  }

  const RecordingFiles& files_;
  std::shared_ptr<const ColumnMap> map_;
  StillParts still_;
  std::vector<const HeadColumns*> heads_;
  std::vector<const GazeColumns*> gazes_;
};

}  // namespace

ImportRequest request_of(const RecordingFiles& files, const FormatCandidate& candidate) {
  ImportRequest request;
  request.head_file = files.head;
  request.gaze_file = files.gaze;
  request.columns = candidate.columns;
  request.still = candidate.still;
  return request;
}

std::vector<FormatCandidate> fitting_formats(const RecordingFiles& files,
                                             std::shared_ptr<const ColumnMap> map, const std::string& variant,
                                             const StillParts& still) {
  std::vector<std::string> variants = variants_of(*map);
  if (!variant.empty()) {
    const std::string all = variants.front().empty() ? "none" : [&] {
      std::string text;
      for (const std::string& name : variants) text += (text.empty() ? "" : ", ") + name;
      return text;
    }();
    if (std::find(variants.begin(), variants.end(), variant) == variants.end())
      throw InputError(files.head.empty() ? files.gaze.value_or(files.head) : files.head, 0,
                       "has no variant '" + printable(variant) + "' by map '" + map->name + "'",
                       "its variants are: " + all);
    variants = {variant};
  }
  const MapFit fit(files, map, still);
  std::vector<FormatCandidate> found;
  for (const std::string& name : variants) {
    const auto candidate = fit.candidate(name);
    if (!candidate) continue;
    const auto same = std::find_if(found.begin(), found.end(), [&](const FormatCandidate& other) {
      return other.columns.head == candidate->columns.head && other.columns.gaze == candidate->columns.gaze;
    });
    if (same == found.end())
      found.push_back(*candidate);
    else
      same->variant.clear();  // the files hold nothing in which the two differ
  }
  if (found.empty()) fit.fail(variant);
  // Where a sibling reads the gaze, one that does not is no alternative.
  const auto has_gaze = [](const FormatCandidate& one) { return one.columns.gaze != nullptr; };
  if (std::any_of(found.begin(), found.end(), has_gaze)) std::erase_if(found, std::not_fn(has_gaze));
  return found;
}

}  // namespace herr
