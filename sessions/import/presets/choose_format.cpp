#include "sessions/import/presets/choose_format.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/import/presets/built_in_maps.h"
#include "sessions/import/presets/proven_angles.h"
#include "sessions/import/presets/recognised_formats.h"
#include "sessions/import/presets/trial_import.h"

namespace herr {
namespace {

void check_variant(const FormatRequest& request, const ColumnMap& map) {
  const std::vector<std::string> known = variants_of(map);
  if (request.variant.empty() || std::find(known.begin(), known.end(), request.variant) != known.end())
    return;
  std::string names;
  for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
  throw InputError(
      any_file(request), 0, "cannot be read as variant '" + printable(request.variant) + "' of " + map.name,
      known.empty() ? "leave --variant out: there are no variants" : "its variants are: " + names);
}

std::vector<FittingColumns> all_fitting(const FormatRequest& request) {
  if (!request.map && request.preset.empty()) {
    std::vector<FittingColumns> formats = recognised(request);
    if (formats.empty()) fail_unrecognised(request);
    return formats;
  }
  std::shared_ptr<const ColumnMap> map = request.map;
  if (!map) {
    const auto& maps = built_in_maps();
    const auto found = std::find_if(maps.begin(), maps.end(),
                                    [&](const BuiltInMap& one) { return one.name == request.preset; });
    map = parsed(*found);
  }
  check_variant(request, *map);
  FittingResult result = fitting(request, map, request.preset);
  if (!result.fitting.empty()) return std::move(result.fitting);
  if (result.missing) fail_misfit(request, *result.missing);
  throw InputError(any_file(request), 0, "holds nothing that map '" + map->name + "' reads",
                   "check --preset, --map and --gaze");
}

struct Tried {
  FittingColumns format;
  TrialImport trial;
  std::string against;  // what makes it implausible, or empty
};

// "preset euroc, variant tumvi (why); preset tum, variant robot, camera (why)".
std::string list_of(const std::vector<Tried>& tried) {
  const bool any_read =
      std::any_of(tried.begin(), tried.end(), [](const Tried& one) { return !one.trial.error; });
  std::string text;
  const Tried* last = nullptr;
  const auto close = [&] {
    text += last != nullptr && !last->against.empty() ? " (" + last->against + ")" : "";
  };
  for (const Tried& one : tried) {
    if (any_read && one.trial.error) continue;
    if (last != nullptr && last->format.map == one.format.map && last->against == one.against &&
        !one.format.variant().empty()) {
      text += ", " + one.format.variant();
      continue;
    }
    close();
    text += (text.empty() ? "" : "; ") + one.format.words();
    last = &one;
  }
  close();
  return text;
}

bool differ(const Tried& a, const Tried& b) {
  return a.trial.rows_hash != b.trial.rows_hash;
}

std::string told_apart(const Tried& chosen, const std::vector<Tried>& others) {
  std::string text = chosen.format.words() + " was taken";
  for (const Tried& one : others) {
    const bool stranger = one.format.map != chosen.format.map && !one.against.empty();
    if (stranger || one.trial.error) continue;  // other formats of as many numbers
    const std::string why = one.against.empty() ? better_because(chosen.trial, one.trial) : one.against;
    if (!why.empty()) text += "; with " + one.format.words() + " " + why;
  }
  return text;
}

// Of equals in the same head: the first, which the map's author put first; the user is told.
bool only_gaze_differs(const std::vector<Tried>& tried) {
  return std::all_of(tried.begin(), tried.end(), [&](const Tried& one) {
    return one.format.columns.head == tried.front().format.columns.head;
  });
}

struct Contest {
  std::vector<Tried> good, bad;  // good: those that differ in any row
};

Contest contest_of(const FormatRequest& request, const std::vector<FittingColumns>& formats,
                   std::int64_t most_rows) {
  Contest contest;
  for (const FittingColumns& format : formats) {
    Tried one{format, trial_import(import_request(request, format.columns), most_rows), {}};
    one.against = implausible(one.trial);
    if (!one.against.empty())
      contest.bad.push_back(std::move(one));
    else if (std::all_of(contest.good.begin(), contest.good.end(),
                         [&](const Tried& other) { return differ(one, other); }))
      contest.good.push_back(std::move(one));
  }
  return contest;
}

// The one that is more plausible than all others, or nothing.
std::optional<ChosenFormat> winner(const Contest& contest) {
  for (const Tried& one : contest.good) {
    if (!std::all_of(contest.good.begin(), contest.good.end(), [&](const Tried& other) {
          return &one == &other || !better_because(one.trial, other.trial).empty();
        }))
      continue;
    std::vector<Tried> others = contest.bad;
    for (const Tried& other : contest.good)
      if (&other != &one) others.push_back(other);
    return ChosenFormat{one.format, {told_apart(one, others)}};
  }
  return std::nullopt;
}

// A preset that reads rows like any other of as many numbers, and only makes no sense of them.
void refuse_wrong_preset(const FormatRequest& request, const Contest& contest) {
  FormatRequest any = request;
  any.preset.clear();
  const std::vector<FittingColumns> all = recognised(any);
  const Contest others = contest_of(any, all, kTrialRows);
  std::vector<FittingColumns> good;
  for (const Tried& one : others.good)
    if (one.format.preset != request.preset) good.push_back(one.format);
  if (good.empty()) return;
  throw InputError(any_file(request), 0, "looks like no person's head and eyes as " + list_of(contest.bad),
                   "it does as preset " + presets_in(good) + "; give --variant or --map to insist");
}

// The user named the format: what fits it best is taken, and warnings follow.
ChosenFormat insisted(const FormatRequest& request, const Contest& contest) {
  if (std::all_of(contest.bad.begin(), contest.bad.end(),
                  [](const Tried& one) { return one.trial.error.has_value(); }))
    throw InputError(*contest.bad.front().trial.error);
  if (!request.map && !request.preset.empty() && request.variant.empty() &&
      contest.bad.front().format.named_columns == 0)
    refuse_wrong_preset(request, contest);
  const std::string remark =
      "looks like no person's head and eyes in any of its formats: " + list_of(contest.bad);
  const auto legible = std::find_if(contest.bad.begin(), contest.bad.end(), [&](const Tried& one) {
    return !one.trial.error &&
           (one.format.map->otherwise.empty() || one.format.variant() == one.format.map->otherwise);
  });
  const bool named = request.map || !request.preset.empty();
  if (named && legible != contest.bad.end())
    return {legible->format, {"the recording " + remark + "; " + legible->format.words() + " was taken"}};
  throw InputError(any_file(request), 0, remark, "give --preset and --variant to insist on one, or --map");
}

ChosenFormat undecided(const FormatRequest& request, const Contest& contest) {
  if (contest.good.empty()) return insisted(request, contest);
  const Tried& first = contest.good.front();
  if (only_gaze_differs(contest.good))
    return {first.format,
            {first.format.words() + " was taken, and the data would also allow " +
             contest.good[1].format.words() + ": give --variant where that is meant"},
            contest.good[1].format.words()};
  const bool one_map = std::all_of(contest.good.begin(), contest.good.end(),
                                   [&](const Tried& one) { return one.format.map == first.format.map; });
  for (const Tried& one : contest.good)
    if (one_map && !one.format.variant().empty() && one.format.variant() == one.format.map->otherwise)
      return {one.format,
              {one.format.words() + " was taken, as the data cannot tell: " + list_of(contest.good) +
               " fit alike; give --variant where another is meant"},
              list_of(contest.good)};
  throw InputError(any_file(request), 0,
                   "fits several formats, and its data cannot tell which: " + list_of(contest.good),
                   "give --preset, and --variant where one is named");
}

ChosenFormat choose(const FormatRequest& request, const std::vector<FittingColumns>& formats) {
  Contest contest = contest_of(request, formats, kTrialRows);
  if (formats.size() == 1 && contest.bad.empty()) return {formats.front(), {}};
  if (auto chosen = winner(contest)) return std::move(*chosen);
  if (contest.good.size() > 1) contest = contest_of(request, formats, kLongTrialRows);  // more of it may tell
  if (auto chosen = winner(contest)) return std::move(*chosen);
  return undecided(request, contest);
}

// The same columns may hold angles by another formula, which the file itself may prove.
void prove_angles(const FormatRequest& request, ChosenFormat& chosen) {
  ImportColumns& columns = chosen.format.columns;
  if (columns.gaze == nullptr) return;
  const std::filesystem::path& file = request.files.gaze ? *request.files.gaze : request.files.head;
  const std::vector<const GazeColumns*> all = fitting_gaze(file, *chosen.format.map, columns.gaze->variant);
  const GazeColumns* proven = proven_angles(file, all);
  if (proven == nullptr || proven == columns.gaze) return;
  columns.gaze = proven;
  chosen.remarks.push_back(
      "the combined ray of the file proves another formula of its angles, which was taken");
}

[[noreturn]] void refuse_missing(const std::filesystem::path& file) {
  if (!file.has_filename() && is_file(file.parent_path()))
    throw InputError(file, 0, "ends with '/', and what stands before it is a file", "leave the '/' out");
  throw InputError(file, 0, "does not exist", "name a recording");
}

ChosenFormat chosen_of(const FormatRequest& request) {
  for (const std::filesystem::path& file : {request.files.head, request.files.gaze.value_or("")})
    if (!file.empty() && !path_exists(file)) refuse_missing(file);
  std::vector<FittingColumns> formats = all_fitting(request);
  const bool recognised_itself = !request.map && request.preset.empty();
  const bool counted = !recognised_itself && !request.map && formats.front().named_columns == 0;
  if (counted) refuse_named_columns(request);
  if (formats.size() > 1 || (counted && request.variant.empty())) return choose(request, formats);
  if (!recognised_itself) return {std::move(formats.front()), {}};
  // The only format that has these columns: what is wrong in it is for its import to say.
  return {formats.front(), {formats.front().words() + " was recognised by its columns"}};
}

}  // namespace

ImportRequest import_request(const FormatRequest& request, const ImportColumns& columns) {
  ImportRequest import;
  import.head_file = request.files.head;
  import.gaze_file = request.files.gaze;
  import.columns = columns;
  import.still = request.still;
  return import;
}

ChosenFormat choose_format(const FormatRequest& request) {
  ChosenFormat chosen = chosen_of(request);
  prove_angles(request, chosen);
  return chosen;
}

}  // namespace herr
