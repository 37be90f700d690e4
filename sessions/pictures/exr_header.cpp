#include "sessions/pictures/exr_header.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <iterator>
#include <limits>
#include <new>
#include <string>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr const char* kAgain = "export the image again";
constexpr std::size_t kLongestHeader = std::size_t{16} << 20;

// Bytes for the library, which is C: what goes wrong is thrown after it has returned.
struct Source {
  HeaderBytes& bytes;
  std::exception_ptr failure;
};

std::int64_t read_bytes(exr_const_context_t, void* user, void* to, std::uint64_t count, std::uint64_t offset,
                        exr_stream_error_func_ptr_t) {
  auto& source = *static_cast<Source*>(user);
  if (offset > kLongestHeader || count > kLongestHeader) return -1;
  try {
    const std::string_view first = source.bytes.first(static_cast<std::size_t>(offset + count));
    const std::size_t begin = std::min(first.size(), static_cast<std::size_t>(offset));
    std::memcpy(to, first.data() + begin, first.size() - begin);
    return static_cast<std::int64_t>(first.size() - begin);
  } catch (...) {
    source.failure = std::current_exception();
    return -1;
  }
}

std::int64_t size_of(exr_const_context_t, void* user) {
  return static_cast<std::int64_t>(static_cast<Source*>(user)->bytes.size_bytes());
}

void ignore_message(exr_const_context_t, exr_result_t, const char*) {}

struct ExrFacts {
  exr_compression_t compression = EXR_COMPRESSION_LAST_TYPE;
  exr_attr_box2i_t data{}, display{};
  const exr_attr_chlist_t* channels = nullptr;
};

void check(const std::filesystem::path& file, exr_result_t result) {
  if (result == EXR_ERR_SUCCESS) return;
  if (result == EXR_ERR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw InputError(file, 0,
                   std::string("cannot be read as an image (") + exr_get_default_error_message(result) + ")",
                   kAgain);
}

void check_compression(const std::filesystem::path& file, exr_compression_t compression) {
  constexpr const char* kNames[] = {"none",  "rle", "zips", "zip",  "piz",
                                    "pxr24", "b44", "b44a", "dwaa", "dwab"};
  static_assert(std::size(kNames) == EXR_COMPRESSION_LAST_TYPE);
  const auto index = static_cast<std::size_t>(compression);
  if (index <= EXR_COMPRESSION_ZIP) return;
  throw InputError(file, 0,
                   std::string("is an EXR with compression ") +
                       (index < std::size(kNames) ? kNames[index] : "of a newer kind"),
                   "use none, RLE, ZIPS or ZIP");
}

void check_windows(const std::filesystem::path& file, const ExrFacts& facts) {
  const exr_attr_box2i_t &data = facts.data, &display = facts.display;
  const bool agree = data.min.x == 0 && data.min.y == 0 && display.min.x == 0 && display.min.y == 0 &&
                     data.max.x == display.max.x && data.max.y == display.max.y;
  if (!agree)
    throw InputError(file, 0, "is an EXR whose data window is not its display window",
                     "crop or pad the image");
}

void check_channels(const std::filesystem::path& file, const exr_attr_chlist_t& channels) {
  const exr_attr_chlist_entry_t *begin = channels.entries, *end = begin + channels.num_channels;
  const auto has = [&](const char* name) {
    return std::any_of(begin, end,
                       [&](const auto& channel) { return std::strcmp(channel.name.str, name) == 0; });
  };
  for (const auto* channel = begin; channel != end; ++channel) {
    if (channel->pixel_type != EXR_PIXEL_HALF && channel->pixel_type != EXR_PIXEL_FLOAT)
      throw InputError(file, 0, "is an EXR with integer channels", "use half or float");
    if (channel->x_sampling != 1 || channel->y_sampling != 1)
      throw InputError(file, 0, "is an EXR with subsampled channels", "save every channel at full size");
  }
  const bool colour = has("R") && has("G") && has("B"), grey = channels.num_channels <= 2 && has("Y");
  if (!colour && !grey) throw InputError(file, 0, "is an EXR without channels R, G, B or Y", kAgain);
}

struct Context {
  exr_context_t handle = nullptr;
  ~Context() {
    if (handle != nullptr) exr_finish(&handle);
  }
};

}  // namespace

PictureHeader read_exr_header(HeaderBytes& bytes) {
  const std::filesystem::path& file = bytes.path();
  Source source{bytes, nullptr};
  exr_context_initializer_t wishes = EXR_DEFAULT_CONTEXT_INITIALIZER;
  wishes.error_handler_fn = ignore_message;
  wishes.user_data = &source;
  wishes.read_fn = read_bytes;
  wishes.size_fn = size_of;
  Context context;
  const exr_result_t started = exr_start_read(&context.handle, file.c_str(), &wishes);
  if (source.failure) std::rethrow_exception(source.failure);
  check(file, started);

  ExrFacts facts;
  check(file, exr_get_compression(context.handle, 0, &facts.compression));
  check(file, exr_get_data_window(context.handle, 0, &facts.data));
  check(file, exr_get_display_window(context.handle, 0, &facts.display));
  check(file, exr_get_channels(context.handle, 0, &facts.channels));
  check_compression(file, facts.compression);
  check_windows(file, facts);
  check_channels(file, *facts.channels);
  const bool half = facts.channels->entries[0].pixel_type == EXR_PIXEL_HALF;
  const auto length = [](std::int32_t last) {  // the window begins at 0
    return last < std::numeric_limits<std::int32_t>::max() ? last + 1 : last;
  };
  return {length(facts.data.max.x), length(facts.data.max.y), facts.channels->num_channels,
          half ? SampleType::half : SampleType::f32};
}

}  // namespace herr
