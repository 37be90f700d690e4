#include "server/study/study_folder.h"

#include <array>
#include <string>
#include <system_error>

#include "server/study/claim_folder.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"

namespace herr {
namespace {

constexpr std::array kStudyNames{"study.csv", "study.json", "study.html", "study.state.json"};

bool is_unfinished_reference(const std::string& name) {
  return temporary_file_pid(name) != 0 && whole_name(name).ends_with(".reference");
}

}  // namespace

FolderLock StudyFolder::prepare(bool overwrite, bool resume) const {
  // References alone are what a study left that was stopped before its first line.
  const OwnFiles own{"study", kStudyNames, references().filename().string(),
                     "go on with it with --resume, replace it with --overwrite"};
  const EarlierFiles earlier = resume      ? EarlierFiles::keep
                               : overwrite ? EarlierFiles::remove
                                           : EarlierFiles::refuse;
  FolderLock lock = claim_folder(path_, own, earlier);
  // References are told apart by what they are of: an earlier study's may serve this one.
  remove_those(references(), is_unfinished_reference);
  if (const std::error_code failed = make_folders(references())) {
    refuse_out_folder(references(), "cannot be made: " + failed.message());
  }
  return lock;
}

}  // namespace herr
