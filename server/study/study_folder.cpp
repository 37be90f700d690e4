#include "server/study/study_folder.h"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>
#include <vector>

#include "server/process/exit_code.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr std::array kStudyNames{"study.csv", "study.json", "study.html", "study.state.json"};

// Without what a file has while it is written.
std::string whole_name(const std::string& name) {
  return temporary_file_pid(name) != 0 ? name.substr(0, name.rfind(".tmp.")) : name;
}

bool is_study_file(const std::string& name) {
  return std::find(kStudyNames.begin(), kStudyNames.end(), whole_name(name)) != kStudyNames.end();
}

bool is_unfinished_reference(const std::string& name) {
  return temporary_file_pid(name) != 0 && whole_name(name).ends_with(".reference");
}

[[noreturn]] void refuse_study_folder(const std::filesystem::path& folder, const std::string& problem) {
  throw UsageError("--out: " + printable(folder.string()) + " " + problem);
}

template <class Goes>
void remove_those(const std::filesystem::path& folder, const Goes& goes) {
  std::error_code error;
  for (const std::string& name : list_folder(folder, error)) {
    if (!goes(name)) continue;
    if (const std::error_code failed = remove_path(folder / name)) {
      refuse_study_folder(folder / name, "cannot be removed: " + failed.message());
    }
  }
}

}  // namespace

FolderLock StudyFolder::prepare(bool overwrite, bool resume) const {
  std::error_code error;
  const std::vector<std::string> names = list_folder(path_, error);
  const bool earlier = std::any_of(names.begin(), names.end(), is_study_file);
  // Alone it is what a study left that was stopped before its first line.
  const bool foreign = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return name != references().filename() && !is_study_file(name);
  });
  if (foreign && !earlier) {
    refuse_study_folder(path_, "is not empty and holds no study; choose another folder");
  }
  if (earlier && !overwrite && !resume) {
    refuse_study_folder(path_, "holds a study; go on with it with --resume, replace it with --overwrite");
  }
  if (const std::error_code failed = make_folders(path_)) {
    refuse_study_folder(path_, "cannot be made: " + failed.message() + "; choose another folder");
  }
  std::optional<FolderLock> lock = FolderLock::take(path_);
  if (!lock) {
    throw TemporaryError("--out: another process is writing into " + printable(path_.string()) +
                         "; wait for its end or choose another folder");
  }
  remove_those(path_, [&](const std::string& name) {
    return is_study_file(name) && !(resume && temporary_file_pid(name) == 0);
  });
  // References are told apart by what they are of: an earlier study's may serve this one.
  remove_those(references(), is_unfinished_reference);
  if (const std::error_code failed = make_folders(references())) {
    refuse_study_folder(references(), "cannot be made: " + failed.message());
  }
  return std::move(*lock);
}

}  // namespace herr
