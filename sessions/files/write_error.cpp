#include "sessions/files/write_error.h"

#include <cerrno>
#include <system_error>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

std::string remedy_for(int error_number) {
  switch (error_number) {
    case ENOSPC:
      return "free space on that disk and run again";
    case EDQUOT:
      return "raise the disk quota and run again";
    case EFBIG:
      return "raise the limit on file sizes (ulimit -f) and run again";
    case EMFILE:
    case ENFILE:
      return "raise the limit on open files (ulimit -n) and run again";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that you may write to";
    default:
      return "check the disk and the folder and run again";
  }
}

}  // namespace

WriteError::WriteError(const std::filesystem::path& file, const std::string& step, int error_number)
    : std::runtime_error(printable(file.string()) + ": cannot " + step + ": " +
                         std::generic_category().message(error_number) + "; " + remedy_for(error_number)),
      error_number_(error_number) {}

}  // namespace herr
