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

LookFormat format_of(const fs::path& out) {
  const std::string ending = out.extension().string();
  if (ending == ".exr") return LookFormat::exr;
  if (ending == ".png") return LookFormat::png;
  throw UsageError("--out: '" + printable(out.string()) +
                   "' ends with neither .png nor .exr; give one of them");
}

}  // namespace

LookFiles look_files(const LookOptions& options) {
  LookFiles files{options.out, LookFormat::png};
  if (options.turntable > 0) {
    if (files.out.empty()) files.out = model_name(options.path) + "-turntable";
    return files;
  }
  if (files.out.empty()) files.out = model_name(options.path) + ".png";
  files.format = format_of(files.out);
  if (is_folder(files.out))
    throw UsageError("--out: '" + printable(files.out.string()) + "' is a folder; give the name of a file");
  if (path_exists(files.out) && !options.overwrite)
    throw UsageError("--out: '" + printable(files.out.string()) +
                     "' is there already; give --overwrite to replace it, or another --out");
  return files;
}

std::string turntable_picture(const LookOptions& options, int number) {
  const std::size_t digits = std::max<std::size_t>(3, std::to_string(options.turntable - 1).size());
  std::string text = std::to_string(number);
  text.insert(0, digits - std::min(digits, text.size()), '0');
  return model_name(options.path) + "-" + text + ".png";
}

bool is_turntable_picture(const std::string& name) {
  const std::size_t dash = name.rfind('-');
  if (dash == std::string::npos || !name.ends_with(".png")) return false;
  const std::string digits = name.substr(dash + 1, name.size() - 4 - dash - 1);
  return digits.size() >= 3 && digits.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace herr
