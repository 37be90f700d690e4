// Bytes and names that outlive a power cut. Used by everything that writes files.
#pragma once

#include <filesystem>

#include "sessions/files/write_error.h"

namespace herr {

// Waits until the disk has the bytes of an open file; `file` is its name for the message. Throws WriteError.
// Not to be tried again after a failure: the kernel may have dropped the pages that it could not write.
void sync_file(int descriptor, const std::filesystem::path& file);

// Makes the names in a folder durable. One call serves any number of new files. Throws WriteError.
void sync_folder(const std::filesystem::path& folder);

}  // namespace herr
