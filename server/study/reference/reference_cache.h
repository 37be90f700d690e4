// References on disk, by what they are pictures of: a study that goes on, or another one of the same frames,
// finds them. A file holds one line of JSON (key, sizes, checksum) and then the two halves as half floats: by
// half, viewport and colour, rows from the top, little-endian. Before: render_halves. After: render_halves,
// which is not called for what is there.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "server/study/reference/reference_picture.h"

namespace herr {

class ReferenceCache {
 public:
  // `folder` is there.
  explicit ReferenceCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // None where there is none of this key, or where it is damaged; then remark() says so, one line.
  std::optional<ReferenceHalves> load(const std::string& key, const DisplayProfile& profile);
  // Throws WriteError.
  void store(const std::string& key, const ReferenceHalves& halves) const;
  const std::string& remark() const { return remark_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path file_of(const std::string& key) const;

  std::filesystem::path folder_;
  std::string remark_;
};

}  // namespace herr
