#include "server/process/exit_code.h"

#include <array>
#include <cerrno>
#include <cstddef>
#include <new>
#include <system_error>

#include "server/process/terminal.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/input_error.h"
#include "sessions/pictures/loaded_module.h"

namespace herr {

int worse_exit_code(int a, int b) {
  const auto rank = [](int code) {
    constexpr std::array<int, 6> kMildToBad{kExitDone,  kExitPartial,   kExitBadInput,
                                            kExitUsage, kExitTemporary, kExitInternal};
    for (std::size_t i = 0; i < kMildToBad.size(); ++i) {
      if (kMildToBad[i] == code) return static_cast<int>(i);
    }
    return static_cast<int>(kMildToBad.size()) + code;  // signals: above all
  };
  return rank(a) >= rank(b) ? a : b;
}

namespace {

// Trying again will not help; another folder will: the command line named the wrong one.
bool may_not_write(int error_number) {
  return error_number == EACCES || error_number == EPERM || error_number == EROFS;
}

}  // namespace

int exit_code_of_current_exception(std::string& message) {
  try {
    throw;
  } catch (const UsageError& error) {
    message = error.what();
    return kExitUsage;
  } catch (const InputError& error) {
    message = error.what();
    return kExitBadInput;
  } catch (const WriteError& error) {
    message = error.what();
    return may_not_write(error.error_number()) ? kExitUsage : kExitTemporary;
  } catch (const ModuleError& error) {
    // Not temporary: job engines start what ends with that code again, and it would end so every time.
    message = error.what();
    return kExitInternal;
  } catch (const TemporaryError& error) {
    message = error.what();
    return kExitTemporary;
  } catch (const std::bad_alloc&) {
    message = "out of memory; use a smaller display profile or polar size, or free memory and try again";
    return kExitTemporary;
  } catch (const std::system_error& error) {
    message = error.what();
    const bool short_of_something = error.code() == std::errc::not_enough_memory ||
                                    error.code() == std::errc::resource_unavailable_try_again ||
                                    error.code() == std::errc::too_many_files_open ||
                                    error.code() == std::errc::too_many_files_open_in_system ||
                                    error.code() == std::errc::no_space_on_device;
    return short_of_something ? kExitTemporary : kExitInternal;
  } catch (const std::exception& error) {
    message = std::string("internal error: ") + error.what() + "; please report it";
    return kExitInternal;
  } catch (...) {
    message = "internal error of unknown kind; please report it";
    return kExitInternal;
  }
}

int run_guarded(const std::function<int()>& body) {
  try {
    return body();
  } catch (...) {
    std::string message;
    const int code = exit_code_of_current_exception(message);
    print_message(message);
    return code;
  }
}

}  // namespace herr
