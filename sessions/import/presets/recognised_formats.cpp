#include "sessions/import/presets/recognised_formats.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/import/presets/built_in_maps.h"
#include "sessions/import/presets/recording_folder.h"

namespace herr {
namespace {

bool looks_like_xml(const std::filesystem::path& file) {
  std::string first(64, ' ');
  InputFile(file).read(first.data(), first.size());
  const std::size_t at = first.find_first_not_of(std::string_view("\xef\xbb\xbf\xff\xfe\0 \t\r\n", 10));
  return at != std::string::npos && first[at] == '<';
}

// What is wrong with a file that cannot be opened as anything: it is empty, of another encoding, no whole
// XML.
std::optional<InputError> fault_of_file(const FormatRequest& request) {
  const bool xml = looks_like_xml(any_file(request));
  std::optional<InputError> fault;
  for (const BuiltInMap& built_in : built_in_maps()) {
    const auto map = parsed(built_in);
    if (map->head.empty() || map->head.front().table.xml_row.empty() == xml) continue;
    const FittingResult result = fitting(request, map, std::string(built_in.name));
    if (!result.unreadable) return std::nullopt;
    if (!fault) fault = result.missing;
  }
  return fault;
}

bool by_names(const std::vector<FittingColumns>& formats) {
  return !formats.empty() && formats.front().named_columns > 0;
}

}  // namespace

std::shared_ptr<const ColumnMap> parsed(const BuiltInMap& map) {
  return std::make_shared<const ColumnMap>(parse_column_map(map.json, std::string(map.name) + ".json"));
}

const std::filesystem::path& any_file(const FormatRequest& request) {
  return request.files.head.empty() ? *request.files.gaze : request.files.head;
}

FittingResult fitting(const FormatRequest& request, const std::shared_ptr<const ColumnMap>& map,
                      const std::string& preset) {
  return fitting_columns(request.files, map, preset, request.variant, request.still);
}

std::vector<FittingColumns> recognised(const FormatRequest& request) {
  std::vector<FittingColumns> all;
  for (const BuiltInMap& map : built_in_maps()) {
    FittingResult result = fitting(request, parsed(map), std::string(map.name));
    std::move(result.fitting.begin(), result.fitting.end(), std::back_inserter(all));
  }
  std::size_t most = 0;
  for (const FittingColumns& one : all) most = std::max(most, one.named_columns);
  std::erase_if(all, [most](const FittingColumns& one) { return one.named_columns < most; });
  // Of several, those that call their files so.
  const auto by_name = [&](const FittingColumns& one) {
    return named_in_layouts(any_file(request), *one.map);
  };
  if (std::any_of(all.begin(), all.end(), by_name)) std::erase_if(all, std::not_fn(by_name));
  return all;
}

std::string presets_in(const std::vector<FittingColumns>& formats) {
  std::string names;
  std::string last;
  for (const FittingColumns& one : formats) {
    if (one.preset == last) continue;
    names += (names.empty() ? "" : ", ") + one.preset;
    last = one.preset;
  }
  return names;
}

void fail_misfit(const FormatRequest& request, const InputError& missing) {
  FormatRequest any = request;
  any.variant.clear();
  const std::vector<FittingColumns> others = recognised(any);
  std::string remedy = missing.remedy();
  if (!others.empty() && others.front().named_columns > 0)
    remedy = "its columns are those of preset " + presets_in(others) + ", not of " +
             (request.preset.empty() ? "this map" : request.preset);
  else if (!others.empty() && !request.preset.empty())
    remedy = "its rows can be read by preset " + presets_in(others) + ", not by " + request.preset;
  throw InputError(missing.file(), missing.line(), missing.problem(), remedy);
}

void fail_unrecognised(const FormatRequest& request) {
  if (const auto fault = fault_of_file(request)) throw *fault;
  FormatRequest other = request;
  if (request.files.gaze && !request.files.head.empty()) {
    std::swap(other.files.head, *other.files.gaze);
    if (const auto formats = recognised(other); by_names(formats))
      throw InputError(request.files.head, 0,
                       "holds the gaze and " + printable(request.files.gaze->string()) +
                           " the head (preset " + presets_in(formats) + ")",
                       "give the files the other way around");
    other = request;
    other.files.gaze.reset();
    if (const auto formats = recognised(other); !formats.empty())
      throw InputError(*request.files.gaze, 0,
                       "has no gaze columns that go with the head's (" + presets_in(formats) + ")",
                       "say both in a --map; 'herr convert --check HEAD --gaze FILE' proposes one");
  } else if (!request.still.head) {
    other.files.gaze = request.files.head;
    other.files.head.clear();
    other.still.head = true;
    if (const auto formats = recognised(other); by_names(formats))
      throw InputError(request.files.head, 0,
                       "holds the gaze of preset " + presets_in(formats) + " and no head",
                       "give the head's file as HEAD and this one with --gaze, or --still-head");
  }
  throw InputError(any_file(request), 0,
                   request.still.head ? "has the gaze columns of no preset" : "has the columns of no preset",
                   "try 'herr convert --check FILE', which proposes a map, or give --preset or --map");
}

void refuse_named_columns(const FormatRequest& request) {
  FormatRequest any = request;
  any.preset.clear();
  any.variant.clear();
  const std::vector<FittingColumns> others = recognised(any);
  if (by_names(others))
    throw InputError(any_file(request), 1,
                     "names columns of preset " + presets_in(others) + ", and preset " + request.preset +
                         " would take them by their place",
                     "take that preset, or say the columns with --map");
}

}  // namespace herr
