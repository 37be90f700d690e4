// Words of a command line that is shown to be pasted into a shell. Before: whoever proposes one. After: a
// person.
#pragma once

#include <filesystem>
#include <string>

namespace herr {

// As a POSIX shell takes it: as it is, or in single quotes.
std::string shell_word(const std::string& word);
// Of a path: one that begins with a dash is no option.
std::string shell_path(const std::filesystem::path& path);

}  // namespace herr
