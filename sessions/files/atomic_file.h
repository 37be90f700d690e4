// A file that appears under its name only when it is complete: written to NAME.tmp.<pid>, synced,
// renamed. Before: an encoder or a text writer hands in bytes. After: the file stands under its
// final name, or nothing does.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "sessions/files/output_file.h"

namespace herr {

// Not thread-safe. Every function throws WriteError; the temporary file never outlives the object.
class AtomicFile {
 public:
  // Creates the temporary file beside `final_name` (O_EXCL: never takes over somebody else's).
  explicit AtomicFile(std::filesystem::path final_name);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const std::uint8_t> bytes);
  void write(std::string_view text);
  // Syncs, closes and renames over the final name. The name itself is durable after sync_folder().
  void commit();

 private:
  std::filesystem::path final_name_, temporary_name_;
  OutputFile file_;
  bool committed_ = false;
};

void write_whole_file(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);
void write_whole_file(const std::filesystem::path& file, std::string_view text);

// For a name NAME.tmp.<pid>: the pid; 0 for any other name.
long temporary_file_pid(const std::string& file_name);

}  // namespace herr
