// The program run to its end by a shell in a folder, as its users run it, and what it left there.
#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace herr {

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

// What a line of the shell leaves behind, run in `folder`.
inline Outcome run_line(const std::filesystem::path& folder, const std::string& line) {
  const int status =
      std::system(("cd '" + folder.string() + "' && " + line + " >stdout.txt 2>stderr.txt").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(folder / "stdout.txt"),
          content_of(folder / "stderr.txt")};
}

// `before` stands before the program's name in the shell's line, e.g. "ulimit -f 8;".
inline Outcome run_program(const std::filesystem::path& folder, const std::string& arguments,
                           const std::string& before = "") {
  return run_line(folder, before + " " + test::program_path() + " " + arguments);
}

// Flags of a command line and what comes on top of them: a flag stands once, so those of `base` that `more`
// has, too, are left out with their values. Words are parted by spaces.
inline std::string with_more(const std::string& base, const std::string& more) {
  const auto words_of = [](const std::string& text) {
    std::istringstream words(text);
    return std::vector<std::string>{std::istream_iterator<std::string>(words), {}};
  };
  const std::vector<std::string> added = words_of(more);
  std::string line;
  bool leave_out = false;
  for (const std::string& word : words_of(base)) {
    if (word.starts_with("--")) leave_out = std::find(added.begin(), added.end(), word) != added.end();
    if (!leave_out) line += word + " ";
  }
  return line + more;
}

inline long lines_in(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

// Regular files, by their paths below the folder, sorted; none where there is no folder.
inline std::vector<std::string> files_below(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  if (!std::filesystem::exists(folder)) return names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) names.push_back(std::filesystem::relative(entry.path(), folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace herr
