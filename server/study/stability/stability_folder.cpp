#include "server/study/stability/stability_folder.h"

#include <array>

#include "server/study/claim_folder.h"

namespace herr {

FolderLock StabilityFolder::prepare(bool overwrite) const {
  static constexpr std::array kNames{"stability.json", "stability.html"};
  return claim_folder(
      path_, {"stability report", kNames, "", "replace it with --overwrite, or choose another folder"},
      overwrite ? EarlierFiles::remove : EarlierFiles::refuse);
}

}  // namespace herr
