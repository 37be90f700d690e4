#include "server/look/look_files.h"

#include <algorithm>
#include <string>

#include "server/process/exit_code.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

// "room" of room.scene.json.
std::string model_name(const fs::path& path) {
  std::string name = path.stem().string();
  if (name.ends_with(".scene")) name.resize(name.size() - 6);
  return name;
}

std::string ending_of(PictureFormat format) {
  return std::string(".") + name_of(format);
}

// Those of --format, else that of the ending of --out, else PNG.
PictureFormats formats_of(const LookOptions& options) {
  if (options.formats && options.formats->empty())
    throw UsageError("--format: with none there is nothing to write; give png, exr or png,exr");
  const std::string ending = options.turntable > 0 ? "" : options.out.extension().string();
  for (const PictureFormat format : kPictureFormats) {
    if (ending != ending_of(format)) continue;
    if (options.formats && !options.formats->has(format))
      throw UsageError("--out: '" + printable(options.out.string()) + "' is no file of --format " +
                       text_of(*options.formats) + "; leave the ending out");
    return options.formats.value_or(format);
  }
  if (options.turntable == 0 && !options.out.empty() && !options.formats)
    throw UsageError("--out: '" + printable(options.out.string()) +
                     "' ends with neither .png nor .exr; give one of them, or --format");
  return options.formats.value_or(PictureFormat::png);
}

// A picture goes to a file: its name is never made of a folder's.
void check_names_a_file(const fs::path& out) {
  const fs::path name = out.filename();
  if (is_folder(out) || name.empty() || name == "." || name == "..")
    throw UsageError("--out: '" + printable(out.string()) + "' is a folder; give the name of a file");
}

// Without an ending that names a format.
fs::path stem_of(const fs::path& out) {
  for (const PictureFormat format : kPictureFormats)
    if (out.extension() == ending_of(format)) return fs::path(out).replace_extension();
  return out;
}

}  // namespace

LookFiles look_files(const LookOptions& options) {
  LookFiles files;
  if (options.turntable == 0 && !options.out.empty()) check_names_a_file(options.out);
  files.formats = formats_of(options);
  if (options.turntable > 0) {
    files.folder = options.out.empty() ? fs::path(model_name(options.path) + "-turntable") : options.out;
    return files;
  }
  const fs::path stem = options.out.empty() ? fs::path(model_name(options.path)) : stem_of(options.out);
  for (const PictureFormat format : kPictureFormats) {
    if (!files.formats.has(format)) continue;
    fs::path file = stem;
    file += ending_of(format);
    if (is_folder(file))
      throw UsageError("--out: '" + printable(file.string()) + "' is a folder; give the name of a file");
    if (path_exists(file) && !options.overwrite)
      throw UsageError("--out: '" + printable(file.string()) +
                       "' is there already; give --overwrite to replace it, or another --out");
    files.files.push_back(file);
  }
  return files;
}

std::string turntable_picture(const LookOptions& options, int number, PictureFormat format) {
  const std::size_t digits = std::max<std::size_t>(3, std::to_string(options.turntable - 1).size());
  std::string text = std::to_string(number);
  text.insert(0, digits - std::min(digits, text.size()), '0');
  return model_name(options.path) + "-" + text + ending_of(format);
}

bool is_turntable_picture(const std::string& name) {
  const std::size_t dash = name.rfind('-');
  const bool picture = std::any_of(kPictureFormats.begin(), kPictureFormats.end(),
                                   [&](PictureFormat format) { return name.ends_with(ending_of(format)); });
  if (dash == std::string::npos || !picture) return false;
  const std::string digits = name.substr(dash + 1, name.size() - 4 - dash - 1);
  return digits.size() >= 3 && digits.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace herr
