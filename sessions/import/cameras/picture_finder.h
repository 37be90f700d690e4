// The picture that a row of a table means, by its file name or by a number in it.
// Before: camera_pictures, the text of a field. After: table_stamps.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "sessions/import/cameras/camera_pictures.h"

namespace herr {

class PictureFinder {
 public:
  // `table`: what errors name. Throws InputError where a number that rows might give stands in two pictures;
  // only once such a row is met.
  PictureFinder(const CameraPictures& pictures, std::filesystem::path table);

  // The picture's place in pictures.files. The name counts with or without folders and extension; a whole
  // number also without its leading zeros. Of several numbers in the names the one that differs most between
  // pictures counts, of such the last.
  std::optional<std::size_t> find(std::string_view field, std::int64_t line) const;

 private:
  std::filesystem::path table_;
  std::map<std::string, std::size_t, std::less<>> by_name_, by_stem_, by_number_;
  std::map<std::string, std::size_t, std::less<>> twice_;  // number -> a second picture with it
  std::vector<std::string> names_;
};

}  // namespace herr
