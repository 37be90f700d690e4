#include "sessions/import/presets/gaze_beside.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr std::array kHeadWords{"head", "poses", "pose", "trajectory"};
constexpr std::array kGazeWords{"gaze", "eyes", "eye"};

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// In capitals where the word that it takes the place of is.
std::string written_as(const std::string& original, std::string word) {
  const auto capital = [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); };
  const auto is_capital = [](char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; };
  if (!is_capital(original[0])) return word;
  if (is_capital(original[1])) std::transform(word.begin(), word.end(), word.begin(), capital);
  word[0] = capital(word[0]);
  return word;
}

bool reads_gaze(const FormatRequest& request) {
  try {
    return choose_format(request).format.columns.gaze != nullptr;
  } catch (const InputError&) {
    return false;
  }
}

bool is_gaze_of(FormatRequest request, const fs::path& gaze) {
  request.files.gaze = gaze;
  return reads_gaze(request);
}

// "walk_gaze.csv" of "walk_head.csv"; "walk_gaze.csv", "walk-gaze.csv" and "gaze.csv" of "walk.csv".
std::vector<std::string> names_beside(const fs::path& head) {
  const std::string name = head.filename().string(), lower = lower_case(name);
  std::vector<std::string> names;
  for (const std::string word : kHeadWords) {
    const std::size_t at = lower.rfind(word);
    if (at == std::string::npos) continue;
    for (const std::string gaze_word : kGazeWords)
      names.push_back(name.substr(0, at) + written_as(name.substr(at, word.size()), gaze_word) +
                      name.substr(at + word.size()));
  }
  const std::string stem = head.stem().string(), ending = head.extension().string();
  for (const std::string gaze_word : kGazeWords) {
    for (const char* between : {"_", "-", "."}) names.push_back(stem + between + gaze_word + ending);
    names.push_back(gaze_word + ending);
  }
  return names;
}

}  // namespace

std::optional<fs::path> gaze_beside(const FormatRequest& request) {
  const fs::path& head = request.files.head;
  if (head.empty() || request.files.gaze || request.still.gaze || request.still.head || reads_gaze(request))
    return std::nullopt;
  for (const std::string& name : names_beside(head)) {
    const fs::path beside = head.parent_path() / name;
    if (beside != head && is_file(beside) && is_gaze_of(request, beside)) return beside;
  }
  return std::nullopt;
}

}  // namespace herr
