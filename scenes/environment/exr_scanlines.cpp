#include "scenes/environment/exr_scanlines.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr std::int64_t kMostUnpacked = std::int64_t{4} << 30;  // 8192 x 4096 pixels of 32 float channels
constexpr std::int64_t kLongestChunk = std::int64_t{1} << 28;
constexpr std::int64_t kTexelBytes = 3 * sizeof(float);

std::int64_t read_from_memory(exr_const_context_t, void* user, void* to, std::uint64_t count,
                              std::uint64_t offset, exr_stream_error_func_ptr_t) {
  const auto& bytes = *static_cast<const std::string_view*>(user);
  if (offset >= bytes.size()) return 0;
  const std::size_t read = std::min(static_cast<std::size_t>(count), bytes.size() - offset);
  std::memcpy(to, bytes.data() + offset, read);
  return static_cast<std::int64_t>(read);
}

std::int64_t bytes_in_memory(exr_const_context_t, void* user) {
  return static_cast<std::int64_t>(static_cast<const std::string_view*>(user)->size());
}

void print_nothing(exr_const_context_t, exr_result_t, const char*) {}

// What the library holds.
struct ExrReading {
  exr_context_t context = nullptr;
  exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
  bool started = false;  // of the pipeline
  ExrReading() = default;
  ExrReading(const ExrReading&) = delete;
  ExrReading& operator=(const ExrReading&) = delete;
  ~ExrReading() {
    if (started) exr_decoding_destroy(context, &pipeline);
    if (context != nullptr) exr_finish(&context);
  }
};

class ExrChunks {
 public:
  ExrChunks(std::string_view bytes, const ExrLayout& layout, const std::array<std::size_t, 3>& channels,
            const std::filesystem::path& file)
      : bytes_(bytes), layout_(layout), channels_(channels), file_(file) {
    lines_ = layout.compression == ExrCompression::zip ? 16 : 1;
    line_bytes_ = checked_line_bytes();
    const std::int64_t chunks = (layout.data.height() + lines_ - 1) / lines_;
    if (layout.header_bytes > bytes.size() ||
        chunks > static_cast<std::int64_t>((bytes.size() - layout.header_bytes) / sizeof(std::uint64_t)))
      damaged("its table of blocks lies behind the end");
    start();
    rgb_.resize(static_cast<std::size_t>(3 * layout.data.width() * lines_));
  }

  void each_line(const ExrScanline& take) {
    const std::int64_t first = std::max(layout_.data.top, layout_.display.top),
                       last = std::min(layout_.data.bottom, layout_.display.bottom);
    for (std::int64_t y = first; y <= last; ++y) {
      const std::int64_t row = y - layout_.data.top;
      if (y == first || row % lines_ == 0) unpack(row / lines_);
      take(static_cast<std::int32_t>(y),
           &rgb_[static_cast<std::size_t>(row % lines_ * 3 * layout_.data.width())]);
    }
  }

 private:
  [[noreturn]] void damaged(const std::string& problem) const {
    throw InputError(file_, 0, "does not decode as EXR (" + problem + "): damaged or cut off",
                     "copy or export the picture again");
  }
  [[noreturn]] void damaged(std::int64_t chunk, const std::string& problem) const {
    damaged("block " + std::to_string(chunk) + " " + problem);
  }
  void check(std::int64_t chunk, exr_result_t result) const {
    if (result == EXR_ERR_OUT_OF_MEMORY) throw std::bad_alloc();
    if (result != EXR_ERR_SUCCESS)
      damaged(chunk, std::string("is refused: ") + exr_get_default_error_message(result));
  }

  std::int64_t checked_line_bytes() const {
    std::int64_t pixel_bytes = 0;
    for (const ExrChannel& channel : layout_.channels)
      pixel_bytes += channel.stored == SampleType::half ? 2 : 4;
    const std::int64_t shown = std::min(layout_.data.height(), layout_.display.height() + 2 * lines_);
    const std::int64_t width = layout_.data.width();
    if (width > kLongestChunk / std::max(pixel_bytes, kTexelBytes) / lines_ ||
        width * pixel_bytes > kMostUnpacked / shown) {
      throw InputError(file_, 0,
                       "is an EXR of " + std::to_string(layout_.channels.size()) +
                           " channels and a data window " + std::to_string(width) +
                           " pixels wide: too large to unpack",
                       "keep the colours alone: oiiotool IN.exr --ch R,G,B -o OUT.exr");
    }
    return width * pixel_bytes;
  }

  void start() {
    exr_context_initializer_t wishes = EXR_DEFAULT_CONTEXT_INITIALIZER;
    wishes.error_handler_fn = print_nothing;
    wishes.user_data = &bytes_;
    wishes.read_fn = read_from_memory;
    wishes.size_fn = bytes_in_memory;
    wishes.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;  // a table that is wrong is an error
    check(0, exr_start_read(&reading_.context, file_.c_str(), &wishes));
    int parts = 0;
    exr_storage_t storage = EXR_STORAGE_LAST_TYPE;
    std::int32_t lines = 0;
    check(0, exr_get_count(reading_.context, &parts));
    check(0, exr_get_storage(reading_.context, 0, &storage));
    check(0, exr_get_scanlines_per_chunk(reading_.context, 0, &lines));
    if (parts != 1 || storage != EXR_STORAGE_SCANLINE || lines != lines_)
      damaged("its attributes contradict each other");
  }

  // Chunk `index` from the top into rgb_.
  void unpack(std::int64_t index) {
    exr_chunk_info_t chunk = checked_chunk(index);
    exr_decode_pipeline_t& pipeline = reading_.pipeline;
    const bool first = !reading_.started;
    reading_.started = true;
    check(index, first ? exr_decoding_initialize(reading_.context, 0, &chunk, &pipeline)
                       : exr_decoding_update(reading_.context, 0, &chunk, &pipeline));
    if (pipeline.channel_count != static_cast<std::int64_t>(layout_.channels.size()))
      damaged(index, "has other channels");
    for (std::size_t c = 3; c-- > 0;) {
      exr_coding_channel_info_t& channel = pipeline.channels[channels_[c]];
      channel.user_bytes_per_element = sizeof(float);
      channel.user_data_type = EXR_PIXEL_FLOAT;
      channel.user_pixel_stride = kTexelBytes;
      channel.user_line_stride = static_cast<std::int32_t>(kTexelBytes * layout_.data.width());
      channel.decode_to_ptr = reinterpret_cast<std::uint8_t*>(&rgb_[c]);
    }
    if (first) check(index, exr_decoding_choose_default_routines(reading_.context, 0, &pipeline));
    check(index, exr_decoding_run(reading_.context, 0, &pipeline));
    // A channel is unpacked once, into the first colour that it is.
    for (std::size_t c = 1; c < 3; ++c) {
      if (channels_[c] != channels_[0]) continue;
      for (std::size_t i = 0; i < rgb_.size(); i += 3) rgb_[i + c] = rgb_[i];
    }
  }

  exr_chunk_info_t checked_chunk(std::int64_t index) const {
    const std::int64_t top = layout_.data.top + index * lines_;
    const std::int64_t lines = std::min<std::int64_t>(lines_, layout_.data.bottom - top + 1);
    exr_chunk_info_t chunk{};
    check(index, exr_read_scanline_chunk_info(reading_.context, 0, static_cast<int>(top), &chunk));
    if (chunk.data_offset < layout_.header_bytes || chunk.data_offset > bytes_.size() ||
        chunk.packed_size > bytes_.size() - chunk.data_offset)
      damaged(index, "ends behind the file");
    if (chunk.start_y != top || chunk.height != lines || chunk.width != layout_.data.width())
      damaged(index, "is not where it should be");
    // What would not become smaller is stored as it is.
    const auto unpacked = static_cast<std::uint64_t>(lines * line_bytes_);
    if (chunk.unpacked_size != unpacked || chunk.packed_size > unpacked ||
        (layout_.compression == ExrCompression::none && chunk.packed_size != unpacked))
      damaged(index, "is not of its length");
    return chunk;
  }

  std::string_view bytes_;
  const ExrLayout& layout_;
  const std::array<std::size_t, 3>& channels_;
  const std::filesystem::path& file_;
  std::int64_t lines_ = 1, line_bytes_ = 0;
  ExrReading reading_;
  std::vector<float> rgb_;  // of one chunk
};

}  // namespace

void read_exr_scanlines(std::string_view bytes, const ExrLayout& layout,
                        const std::array<std::size_t, 3>& channels, const std::filesystem::path& file,
                        const ExrScanline& take) {
  ExrChunks(bytes, layout, channels, file).each_line(take);
}

}  // namespace herr
