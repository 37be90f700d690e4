#include "sessions/import/presets/fitting_columns.h"

#include <algorithm>
#include <utility>

#include "sessions/import/rows/gaze_reader.h"
#include "sessions/import/rows/head_reader.h"
#include "sessions/import/rows/time_reader.h"
#include "sessions/import/rows/told_columns.h"
#include "sessions/import/tables/row_source.h"

namespace herr {
namespace {

// What an alternative lacks in a file.
struct Misfit {
  InputError error;
  std::size_t missing_columns = 0, wanted_columns = 0;
  bool unreadable = false;  // no column was looked for
};

constexpr int kFirstRows = 20;

// Reads one row; throws InputError where that cannot be.
void read_row(RowSource& rows, const HeadColumns& columns) {
  ReadingCounts counts;
  (void)HeadReader(rows, columns).read(rows, counts);
}

void read_row(RowSource& rows, const GazeColumns& columns) {
  ReadingCounts counts;
  GazeRow row;
  GazeReader(rows, columns).read(rows, nullptr, {}, row, counts);
}

// Columns that are only counted fit any table that is wide enough: one of the first rows has to be legible,
// too.
template <typename Columns>
std::optional<Misfit> illegible(const std::filesystem::path& file, const Columns& columns) {
  const std::vector<ColumnRef> wanted = columns_of(columns);
  if (std::any_of(wanted.begin(), wanted.end(), [](const ColumnRef& column) { return column.number == 0; }))
    return std::nullopt;
  const std::unique_ptr<RowSource> rows = open_rows(file, columns.table, wanted);
  TimeReader time(*rows, columns.time);
  for (const ColumnRef& column : wanted) (void)rows->place(column);
  std::optional<Misfit> first;
  for (int i = 0; i < kFirstRows; ++i) {
    try {
      if (!rows->next()) break;
      (void)time.read(*rows);
      read_row(*rows, columns);
      return std::nullopt;
    } catch (const InputError& error) {
      if (!first) first = Misfit{error, 0};
    }
  }
  return first;
}

template <typename Columns>
std::optional<Misfit> misfit(const std::filesystem::path& file, const Columns& columns) {
  const std::vector<ColumnRef> wanted = columns_of(columns);
  try {
    const std::unique_ptr<RowSource> rows = open_rows(file, columns.table, wanted);
    std::optional<Misfit> found;
    for (const ColumnRef& column : wanted) {
      if (rows->has(column)) continue;
      try {
        (void)rows->place(column);
      } catch (const InputError& error) {
        if (!found) found = Misfit{error, 0, wanted.size()};
        ++found->missing_columns;
      }
    }
    if (found) return found;
    if (const auto told_otherwise = contradicted(*rows, columns)) return Misfit{*told_otherwise, 0};
    return illegible(file, columns);
  } catch (const InputError& error) {
    return Misfit{error, wanted.size(), wanted.size(), true};
  }
}

template <typename Columns>
struct Fits {
  std::vector<const Columns*> columns;
  std::optional<Misfit> nearest;  // of those that do not fit
};

template <typename Columns>
Fits<Columns> fits_in(const std::filesystem::path& file, const std::vector<const Columns*>& alternatives) {
  Fits<Columns> fits;
  for (const Columns* columns : alternatives) {
    // Of one variant the first that fits: what follows asks for less.
    if (std::any_of(fits.columns.begin(), fits.columns.end(),
                    [&](const Columns* before) { return before->variant == columns->variant; }))
      continue;
    const std::optional<Misfit> lacks = misfit(file, *columns);
    if (!lacks)
      fits.columns.push_back(columns);
    else if (!fits.nearest || lacks->missing_columns < fits.nearest->missing_columns)
      fits.nearest = lacks;
  }
  return fits;
}

bool belong_together(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() || a == b;
}

template <typename Columns>
std::size_t named(const Columns& columns) {
  const std::vector<ColumnRef> wanted = columns_of(columns);
  return static_cast<std::size_t>(std::count_if(wanted.begin(), wanted.end(),
                                                [](const ColumnRef& column) { return column.number == 0; }));
}

// Where the gaze would stand; none: nowhere.
std::optional<std::filesystem::path> gaze_file_of(const RecordingFiles& files, const GazeColumns& gaze) {
  if (files.gaze) return files.gaze;
  if (gaze.in_head_file && !files.head.empty()) return files.head;
  return std::nullopt;
}

template <typename Columns>
std::vector<const Columns*> of_variant(const std::vector<Columns>& all, const std::string& variant) {
  std::vector<const Columns*> chosen;
  for (const Columns& columns : all)
    if (belong_together(columns.variant, variant)) chosen.push_back(&columns);
  return chosen;
}

Fits<HeadColumns> head_fits(const RecordingFiles& files, const ColumnMap& map, const std::string& variant,
                            const StillParts& still) {
  if (still.head) return {{nullptr}, {}};
  if (map.head.empty())
    return {{},
            Misfit{InputError(files.head, 0, "has no head in the format '" + map.name + "', only gaze",
                              "give --still-head, or a recording of the head with --map"),
                   0}};
  return fits_in(files.head, of_variant(map.head, variant));
}

Fits<GazeColumns> gaze_fits(const RecordingFiles& files, const ColumnMap& map, const std::string& variant,
                            const StillParts& still) {
  if (still.gaze) return {{nullptr}, {}};
  std::vector<const GazeColumns*> there;
  std::optional<std::filesystem::path> file;
  for (const GazeColumns* gaze : of_variant(map.gaze, variant)) {
    const auto stands_in = gaze_file_of(files, *gaze);
    if (!stands_in) continue;
    file = stands_in;
    there.push_back(gaze);
  }
  if (!there.empty()) {
    Fits<GazeColumns> fits = fits_in(*file, there);
    // A head's log that could hold gaze need not; one that names half of it was meant to.
    const bool half_there = fits.nearest && !fits.nearest->unreadable && fits.nearest->missing_columns > 0 &&
                            2 * fits.nearest->missing_columns < fits.nearest->wanted_columns;
    if (fits.columns.empty() && !files.gaze && !half_there) return {{nullptr}, {}};
    if (fits.columns.empty() && !files.gaze)
      fits.nearest->error =
          InputError(fits.nearest->error.file(), fits.nearest->error.line(),
                     fits.nearest->error.problem() + ", and holds other columns of the gaze",
                     "correct the name, or give --still-gaze where no gaze is meant");
    return fits;
  }
  if (files.gaze)
    return {{},
            Misfit{InputError(*files.gaze, 0, "cannot be read: map '" + map.name + "' has no gaze",
                              "leave --gaze out, or write a map that has one"),
                   0}};
  return {{nullptr}, {}};
}

}  // namespace

std::string FittingColumns::variant() const {
  if (columns.head != nullptr && !columns.head->variant.empty()) return columns.head->variant;
  return columns.gaze != nullptr ? columns.gaze->variant : "";
}

std::string FittingColumns::words() const {
  std::string text = preset.empty() ? "map '" + map->name + "'" : "preset " + preset;
  if (!variant().empty()) text += ", variant " + variant();
  return text;
}

// Of head and gaze, each once, in the order of the map.
std::vector<std::string> variants_of(const ColumnMap& map) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const HeadColumns& head : map.head) add(head.variant);
  for (const GazeColumns& gaze : map.gaze) add(gaze.variant);
  return names;
}

FittingResult fitting_columns(const RecordingFiles& files, const std::shared_ptr<const ColumnMap>& map,
                              const std::string& preset, const std::string& variant,
                              const StillParts& still) {
  const Fits<HeadColumns> heads = head_fits(files, *map, variant, still);
  const Fits<GazeColumns> gazes = gaze_fits(files, *map, variant, still);
  FittingResult result;
  for (const HeadColumns* head : heads.columns)
    for (const GazeColumns* gaze : gazes.columns) {
      if (head == nullptr && gaze == nullptr) continue;
      if (head != nullptr && gaze != nullptr && !belong_together(head->variant, gaze->variant)) continue;
      FittingColumns fitting{map, preset, {head, gaze}, 0};
      fitting.named_columns = (head != nullptr ? named(*head) : 0) + (gaze != nullptr ? named(*gaze) : 0);
      result.fitting.push_back(std::move(fitting));
    }
  if (!result.fitting.empty()) return result;
  if (const auto& nearest = heads.nearest ? heads.nearest : gazes.nearest) {
    result.missing = nearest->error;
    result.unreadable = nearest->unreadable;
  }
  return result;
}

std::vector<const GazeColumns*> fitting_gaze(const std::filesystem::path& file, const ColumnMap& map,
                                             const std::string& variant) {
  std::vector<const GazeColumns*> found;
  for (const GazeColumns& gaze : map.gaze)
    if (gaze.variant == variant && !misfit(file, gaze)) found.push_back(&gaze);
  return found;
}

}  // namespace herr
