// Takes a folder for a report's files and keeps other processes out; what a user has there of their own
// stays. Before: StudyFolder, StabilityFolder. After: the report is written.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "sessions/files/folder_lock.h"

namespace herr {

struct OwnFiles {
  std::string what;                    // "study": for messages
  std::span<const char* const> names;  // what is written into the folder
  std::string beside;                  // a folder that may be all there is; empty: none
  std::string remedy;                  // for earlier files that may not be touched
};

enum class EarlierFiles { refuse, remove, keep };

// Makes the folder. Other files stay as they are; where there are only others the folder is refused. What a
// killed process was writing is removed. Throws UsageError, WriteError, TemporaryError.
FolderLock claim_folder(const std::filesystem::path& folder, const OwnFiles& own, EarlierFiles earlier);

// Removes what `goes(name)` says. Throws UsageError.
void remove_those(const std::filesystem::path& folder,
                  const std::function<bool(const std::string& name)>& goes);

// The name that a file has once it is whole.
std::string whole_name(const std::string& name);

[[noreturn]] void refuse_out_folder(const std::filesystem::path& folder, const std::string& problem);

}  // namespace herr
