#include "server/text/shell_word.h"

namespace herr {

std::string shell_word(const std::string& word) {
  const bool plain =
      !word.empty() &&
      word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%") ==
          std::string::npos;
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string shell_path(const std::filesystem::path& path) {
  const std::string word = path.string();
  return shell_word(word.starts_with("-") ? "./" + word : word);
}

}  // namespace herr
