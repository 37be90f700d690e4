#include "sessions/import/cameras/picture_order.h"

#include <algorithm>
#include <cstddef>
#include <set>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

std::string quoted_name(const std::filesystem::path& file) {
  return "'" + printable(file.filename().string()) + "'";
}

}  // namespace

std::filesystem::path folder_of(const CameraPictures& pictures) {
  return pictures.files.front().parent_path();
}

void put_in_order(StampedPictures& stamped, const CameraPictures& pictures, const std::string& lacks) {
  const std::string all = std::to_string(pictures.files.size());
  std::set<std::filesystem::path> named;
  for (const StampedPicture& picture : stamped.pictures) named.insert(picture.file);
  const auto missing = std::find_if(pictures.files.begin(), pictures.files.end(),
                                    [&](const auto& file) { return !named.contains(file); });
  stamped.without_stamp = static_cast<std::int64_t>(pictures.files.size() - named.size());
  if (missing != pictures.files.end())
    stamped.remarks.push_back(std::to_string(stamped.without_stamp) + " of " + all + " pictures " + lacks +
                              " and are left out (the first is " + quoted_name(*missing) + ")");
  std::stable_sort(stamped.pictures.begin(), stamped.pictures.end(),
                   [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
  const auto equal = [](const auto& a, const auto& b) { return a.stamp_ns == b.stamp_ns; };
  const auto twin = std::adjacent_find(stamped.pictures.begin(), stamped.pictures.end(), equal);
  if (twin != stamped.pictures.end()) {
    const std::string first = quoted_name(std::next(twin)->file) + " has that of " + quoted_name(twin->file);
    const std::size_t before = stamped.pictures.size();
    stamped.pictures.erase(std::unique(stamped.pictures.begin(), stamped.pictures.end(), equal),
                           stamped.pictures.end());
    stamped.repeated_stamps = static_cast<std::int64_t>(before - stamped.pictures.size());
    stamped.remarks.push_back(std::to_string(stamped.repeated_stamps) + " of " + all +
                              " pictures repeat the stamp of another and are left out (" + first + ")");
  }
  if (stamped.pictures.empty())
    throw InputError(folder_of(pictures), 0, "holds " + all + " pictures, which " + lacks,
                     "check the folder, or give --camera-hz: the stamps are then assumed");
}

void refuse_whole_seconds(const StampedPictures& stamped, const std::vector<bool>& seconds_only,
                          const std::string& where) {
  std::set<TimeNs> with_whole, all;
  for (std::size_t i = 0; i < stamped.pictures.size(); ++i) {
    const TimeNs second = stamped.pictures[i].stamp_ns / 1'000'000'000;
    const bool shared = seconds_only[i] ? all.contains(second) : with_whole.contains(second);
    if (shared)
      throw InputError(stamped.pictures[i].file, 0,
                       where + " has whole seconds only, and several pictures share one",
                       "give a table of stamps (--camera-stamps) or names with finer time (--camera-names)");
    all.insert(second);
    if (seconds_only[i]) with_whole.insert(second);
  }
}

}  // namespace herr
