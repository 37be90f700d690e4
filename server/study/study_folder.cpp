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

bool is_study_file(const std::string& name) {
  const std::string whole = temporary_file_pid(name) != 0 ? name.substr(0, name.rfind(".tmp.")) : name;
  return std::find(kStudyNames.begin(), kStudyNames.end(), whole) != kStudyNames.end() ||
         whole.ends_with(".reference");
}

[[noreturn]] void refuse_study_folder(const std::filesystem::path& folder, const std::string& problem) {
  throw UsageError("--out: " + printable(folder.string()) + " " + problem);
}

void remove_study_files(const std::filesystem::path& folder, bool leftovers_only) {
  std::error_code error;
  for (const std::string& name : list_folder(folder, error)) {
    if (!is_study_file(name) || (leftovers_only && temporary_file_pid(name) == 0)) continue;
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
  if (!names.empty() && !earlier) {
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
  remove_study_files(path_, resume);
  // References are told apart by what they are of: an earlier study's may serve this one.
  remove_study_files(references(), true);
  if (const std::error_code failed = make_folders(references())) {
    refuse_study_folder(references(), "cannot be made: " + failed.message());
  }
  return std::move(*lock);
}

}  // namespace herr
