#include "scenes/voxels/vox_bytes.h"

#include "sessions/files/input_error.h"

namespace herr {

std::string_view VoxBytes::take(std::size_t count, const char* what) {
  if (count > left()) {
    fail(std::string(what) + " needs " + std::to_string(count) + " bytes where " + std::to_string(left()) +
             " are left",
         "the file is cut off or damaged: export it again");
  }
  const std::string_view taken = bytes_.substr(at_, count);
  at_ += count;
  return taken;
}

std::int32_t VoxBytes::int32(const char* what) {
  const std::string_view taken = take(4, what);
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<std::uint8_t>(taken[i]);
  return static_cast<std::int32_t>(value);
}

std::size_t VoxBytes::count(std::size_t bytes_each, const char* what) {
  const std::int32_t value = int32(what);
  if (value < 0 || static_cast<std::size_t>(value) > left() / bytes_each) {
    fail(std::string(what) + " is " + std::to_string(value) + ", more than the " + std::to_string(left()) +
             " bytes that follow can hold",
         "the file is cut off or damaged: export it again");
  }
  return static_cast<std::size_t>(value);
}

std::string VoxBytes::text(const char* what) {
  return std::string(take(count(1, what), what));
}

VoxBytes VoxBytes::part(std::size_t count, const char* what) {
  const std::size_t from = offset();
  return {take(count, what), *file_, from};
}

void VoxBytes::fail(const std::string& problem, const std::string& remedy) const {
  throw InputError(*file_, 0, "at byte " + std::to_string(offset()) + " " + problem, remedy);
}

}  // namespace herr
