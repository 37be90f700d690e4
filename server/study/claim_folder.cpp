#include "server/study/claim_folder.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <system_error>
#include <vector>

#include "server/process/exit_code.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {

std::string whole_name(const std::string& name) {
  return temporary_file_pid(name) != 0 ? name.substr(0, name.rfind(".tmp.")) : name;
}

void refuse_out_folder(const std::filesystem::path& folder, const std::string& problem) {
  throw UsageError("--out: " + printable(folder.string()) + " " + problem);
}

void remove_those(const std::filesystem::path& folder,
                  const std::function<bool(const std::string& name)>& goes) {
  std::error_code error;
  for (const std::string& name : list_folder(folder, error)) {
    if (!goes(name)) continue;
    if (const std::error_code failed = remove_path(folder / name)) {
      refuse_out_folder(folder / name, "cannot be removed: " + failed.message());
    }
  }
}

FolderLock claim_folder(const std::filesystem::path& folder, const OwnFiles& own, EarlierFiles earlier) {
  const auto is_own = [&](const std::string& name) {
    return std::find(own.names.begin(), own.names.end(), whole_name(name)) != own.names.end();
  };
  std::error_code error;
  const std::vector<std::string> names = list_folder(folder, error);
  const bool has_own = std::any_of(names.begin(), names.end(), is_own);
  const bool has_foreign = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return name != own.beside && !is_own(name);
  });
  if (has_foreign && !has_own) {
    refuse_out_folder(folder, "is not empty and holds no " + own.what + "; choose another folder");
  }
  if (has_own && earlier == EarlierFiles::refuse) {
    refuse_out_folder(folder, "holds a " + own.what + "; " + own.remedy);
  }
  if (const std::error_code failed = make_folders(folder)) {
    refuse_out_folder(folder, "cannot be made: " + failed.message() + "; choose another folder");
  }
  std::optional<FolderLock> lock = FolderLock::take(folder);
  if (!lock) {
    throw TemporaryError("--out: another process is writing into " + printable(folder.string()) +
                         "; wait for its end or choose another folder");
  }
  remove_those(folder, [&](const std::string& name) {
    return is_own(name) && !(earlier == EarlierFiles::keep && temporary_file_pid(name) == 0);
  });
  return std::move(*lock);
}

}  // namespace herr
