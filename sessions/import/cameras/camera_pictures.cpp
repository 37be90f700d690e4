#include "sessions/import/cameras/camera_pictures.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <system_error>

#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// The number at the start of `text`, without leading zeros; cut off.
std::string_view take_number(std::string_view& text) {
  const auto end =
      static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_digit) - text.begin());
  std::string_view digits = text.substr(0, end);
  text.remove_prefix(end);
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

bool is_picture(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png" || extension == ".exr";
}

std::string size_text(const ImageSize& size) {
  return std::to_string(size.width_px) + "x" + std::to_string(size.height_px);
}

}  // namespace

bool natural_less(const std::string& a, const std::string& b) {
  std::string_view x = a, y = b;
  while (!x.empty() && !y.empty()) {
    if (is_digit(x.front()) && is_digit(y.front())) {
      const std::string_view m = take_number(x), n = take_number(y);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
    } else {
      if (x.front() != y.front()) return x.front() < y.front();
      x.remove_prefix(1);
      y.remove_prefix(1);
    }
  }
  if (x.empty() != y.empty()) return x.empty();
  return a < b;  // "01" and "1": some order, always the same
}

CameraPictures find_camera_pictures(const std::filesystem::path& folder,
                                    const std::function<bool(const std::string&)>& keep) {
  CameraPictures pictures;
  std::error_code error;
  for (const std::string& name : list_folder(folder, error))
    if (is_picture(name) && (!keep || keep(std::filesystem::path(name).stem().string())))
      pictures.files.push_back(folder / name);
  if (error) throw InputError(folder, 0, "cannot be listed: " + error.message(), "name a folder of pictures");
  if (pictures.files.empty())
    throw InputError(folder, 0, keep ? "holds no pictures whose names fit the pattern" : "holds no pictures",
                     "name a folder of .jpg, .png or .exr files");
  std::sort(pictures.files.begin(), pictures.files.end(), [](const auto& a, const auto& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  for (const std::filesystem::path& file : pictures.files) {
    const ImageSize size = read_image_size(file);
    if (file == pictures.files.front()) pictures.size = size;
    if (size.width_px != pictures.size.width_px || size.height_px != pictures.size.height_px)
      throw InputError(
          file, 0,
          "is " + size_text(size) + ", and " + pictures.files.front().filename().string() + " is " +
              size_text(pictures.size),
          "keep pictures of one size in a folder, or take those of one camera with --camera-names");
  }
  return pictures;
}

}  // namespace herr
