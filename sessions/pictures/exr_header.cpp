#include "sessions/pictures/exr_header.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <cmath>
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

void check(const std::filesystem::path& file, exr_result_t result) {
  if (result == EXR_ERR_SUCCESS) return;
  if (result == EXR_ERR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw InputError(file, 0,
                   std::string("cannot be read as an image (") + exr_get_default_error_message(result) + ")",
                   kAgain);
}

ExrCompression known_compression(const std::filesystem::path& file, exr_compression_t compression) {
  constexpr const char* kNames[] = {"none",  "rle", "zips", "zip",  "piz",
                                    "pxr24", "b44", "b44a", "dwaa", "dwab"};
  static_assert(std::size(kNames) == EXR_COMPRESSION_LAST_TYPE);
  const auto index = static_cast<std::size_t>(compression);
  if (index <= EXR_COMPRESSION_ZIP) return static_cast<ExrCompression>(index);
  throw InputError(file, 0,
                   std::string("is an EXR with compression ") +
                       (index < std::size(kNames) ? kNames[index] : "of a newer kind") +
                       ", where none, rle, zips and zip are read",
                   exr_conversion());
}

void check_windows(const std::filesystem::path& file, const ExrLayout& layout) {
  const ExrWindow &data = layout.data, &display = layout.display;
  const bool agree = data.left == 0 && data.top == 0 && display.left == 0 && display.top == 0 &&
                     data.right == display.right && data.bottom == display.bottom;
  if (!agree)
    throw InputError(file, 0, "is an EXR whose data window is not its display window",
                     "crop or pad the image");
}

void check_channels(const std::filesystem::path& file, const std::vector<ExrChannel>& channels) {
  const auto has = [&](const char* name) {
    return std::any_of(channels.begin(), channels.end(),
                       [&](const ExrChannel& channel) { return channel.name == name; });
  };
  for (const ExrChannel& channel : channels) {
    if (channel.stored == SampleType::other)
      throw InputError(file, 0, "is an EXR with integer channels", "use half or float");
    if (channel.subsampled)
      throw InputError(file, 0, "is an EXR with subsampled channels", "save every channel at full size");
  }
  const bool colour = has("R") && has("G") && has("B"), grey = channels.size() <= 2 && has("Y");
  if (!colour && !grey) throw InputError(file, 0, "is an EXR without channels R, G, B or Y", kAgain);
}

ExrWindow window_of(const std::filesystem::path& file, const exr_attr_box2i_t& box) {
  const ExrWindow window{box.min.x, box.min.y, box.max.x, box.max.y};
  if (window.width() < 1 || window.height() < 1)
    throw InputError(file, 0, "is an EXR without pixels", kAgain);
  return window;
}

// Behind the attributes: name, type, size, value each, and an empty name at the end.
std::size_t end_of_attributes(HeaderBytes& bytes) {
  std::size_t at = 8;  // magic and version
  const auto skip_text = [&] {
    std::string_view read = bytes.first(at + 256);
    const std::size_t end = read.find('\0', at);
    if (end == std::string_view::npos) return std::size_t{0};
    const std::size_t length = end - at;
    at = end + 1;
    return length;
  };
  while (at < kLongestHeader && skip_text() > 0) {
    skip_text();
    const std::string_view read = bytes.first(at + 4);
    if (read.size() < at + 4) break;
    std::uint32_t size = 0;
    std::memcpy(&size, read.data() + at, 4);
    at += 4 + std::size_t{size};
  }
  return at;
}

bool of_srgb(const exr_attr_chromaticities_t& given) {
  const float values[] = {given.red_x,  given.red_y,  given.green_x, given.green_y,
                          given.blue_x, given.blue_y, given.white_x, given.white_y};
  constexpr float kSrgb[] = {0.640f, 0.330f, 0.300f, 0.600f, 0.150f, 0.060f, 0.3127f, 0.3290f};
  return std::equal(std::begin(values), std::end(values), std::begin(kSrgb),
                    [](float a, float b) { return std::abs(a - b) <= 0.002f; });
}

struct Context {
  exr_context_t handle = nullptr;
  ~Context() {
    if (handle != nullptr) exr_finish(&handle);
  }
};

}  // namespace

std::string exr_conversion(const std::string& more) {
  return "convert it: oiiotool IN.exr " + more + "--scanline --compression zip -o OUT.exr";
}

ExrLayout read_exr_layout(HeaderBytes& bytes) {
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

  exr_compression_t compression = EXR_COMPRESSION_LAST_TYPE;
  exr_attr_box2i_t data{}, display{};
  const exr_attr_chlist_t* channels = nullptr;
  check(file, exr_get_compression(context.handle, 0, &compression));
  check(file, exr_get_data_window(context.handle, 0, &data));
  check(file, exr_get_display_window(context.handle, 0, &display));
  check(file, exr_get_channels(context.handle, 0, &channels));
  ExrLayout layout;
  layout.compression = known_compression(file, compression);
  layout.data = window_of(file, data);
  layout.display = window_of(file, display);
  for (const auto* one = channels->entries; one != channels->entries + channels->num_channels; ++one) {
    const SampleType stored = one->pixel_type == EXR_PIXEL_HALF    ? SampleType::half
                              : one->pixel_type == EXR_PIXEL_FLOAT ? SampleType::f32
                                                                   : SampleType::other;
    layout.channels.push_back({one->name.str, stored, one->x_sampling != 1 || one->y_sampling != 1});
  }
  const exr_attribute_t* found = nullptr;
  layout.cube_map = exr_get_attribute_by_name(context.handle, 0, "envmap", &found) == EXR_ERR_SUCCESS &&
                    found->type == EXR_ATTR_ENVMAP && found->uc == EXR_ENVMAP_CUBE;
  layout.other_primaries =
      exr_get_attribute_by_name(context.handle, 0, "chromaticities", &found) == EXR_ERR_SUCCESS &&
      found->type == EXR_ATTR_CHROMATICITIES && !of_srgb(*found->chromaticities);
  layout.header_bytes = end_of_attributes(bytes);
  return layout;
}

PictureHeader read_exr_header(HeaderBytes& bytes) {
  const ExrLayout layout = read_exr_layout(bytes);
  check_windows(bytes.path(), layout);
  check_channels(bytes.path(), layout.channels);
  const auto length = [](std::int64_t side) {
    return static_cast<std::int32_t>(std::min<std::int64_t>(side, std::numeric_limits<std::int32_t>::max()));
  };
  return {length(layout.data.width()), length(layout.data.height()),
          static_cast<std::int32_t>(layout.channels.size()), layout.channels.front().stored};
}

}  // namespace herr
