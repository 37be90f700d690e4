#include "scenes/environment/exr_scanlines.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr std::int64_t kMostUnpacked = std::int64_t{4} << 30;  // 8192 x 4096 pixels of 32 float channels
constexpr std::int64_t kLongestChunk = std::int64_t{1} << 28;

std::int64_t sample_bytes(const ExrChannel& channel) {
  return channel.stored == SampleType::half ? 2 : 4;
}

std::int64_t lines_of_chunk(ExrCompression compression) {
  return compression == ExrCompression::zip ? 16 : 1;
}

class ExrChunks {
 public:
  ExrChunks(std::string_view bytes, const ExrLayout& layout, const std::filesystem::path& file)
      : bytes_(bytes), layout_(layout), file_(file), lines_(lines_of_chunk(layout.compression)) {
    std::int64_t pixel_bytes = 0;
    for (const ExrChannel& channel : layout.channels) {
      channel_offset_.push_back(layout.data.width() * pixel_bytes);
      pixel_bytes += sample_bytes(channel);
    }
    const std::int64_t shown = std::min(layout.data.height(), layout.display.height() + 2 * lines_);
    const std::int64_t width = layout.data.width();
    if (width > kLongestChunk / pixel_bytes / lines_ || width * pixel_bytes > kMostUnpacked / shown) {
      throw InputError(file, 0,
                       "is an EXR of " + std::to_string(layout.channels.size()) +
                           " channels and a data window " + std::to_string(width) +
                           " pixels wide: too large to unpack",
                       "keep the colours alone: oiiotool IN.exr --ch R,G,B -o OUT.exr");
    }
    line_bytes_ = width * pixel_bytes;
  }

  void each_line(const std::array<std::size_t, 3>& channels, const ExrScanline& take) {
    const std::int64_t first = std::max(layout_.data.top, layout_.display.top),
                       last = std::min(layout_.data.bottom, layout_.display.bottom);
    std::vector<float> rgb(3 * static_cast<std::size_t>(layout_.data.width()));
    for (std::int64_t y = first; y <= last; ++y) {
      const std::int64_t row = y - layout_.data.top;
      if (y == first || row % lines_ == 0) unpack(row / lines_);
      const std::size_t line = static_cast<std::size_t>(row % lines_ * line_bytes_);
      for (std::size_t c = 0; c < 3; ++c) values(line, channels[c], &rgb[c]);
      take(static_cast<std::int32_t>(y), rgb.data());
    }
  }

 private:
  [[noreturn]] void damaged(std::int64_t chunk, const std::string& problem) const {
    throw InputError(
        file_, 0,
        "does not decode as EXR (block " + std::to_string(chunk) + " " + problem + "): damaged or cut off",
        "copy or export the picture again");
  }

  template <typename Integer>
  Integer integer_at(std::int64_t chunk, std::uint64_t at) const {
    if (at > bytes_.size() || bytes_.size() - at < sizeof(Integer)) damaged(chunk, "lies behind the end");
    Integer value{};
    std::memcpy(&value, bytes_.data() + at, sizeof value);
    return value;
  }

  // Chunk `index` from the top into lines_of_chunk_.
  void unpack(std::int64_t index) {
    const auto at =
        integer_at<std::uint64_t>(index, layout_.header_bytes + 8 * static_cast<std::uint64_t>(index));
    const std::int64_t top = layout_.data.top + index * lines_;
    if (at < layout_.header_bytes || integer_at<std::int32_t>(index, at) != top)
      damaged(index, "is not where it should be");
    const auto packed_bytes = integer_at<std::uint32_t>(index, at + 4);
    if (packed_bytes > bytes_.size() - (at + 8)) damaged(index, "ends behind the file");
    const std::string_view packed = bytes_.substr(at + 8, packed_bytes);
    const std::int64_t lines = std::min<std::int64_t>(lines_, layout_.data.bottom - top + 1);
    unpacked_.resize(static_cast<std::size_t>(lines * line_bytes_));
    // What would not become smaller is stored as it is.
    if (packed.size() == unpacked_.size()) {
      std::memcpy(unpacked_.data(), packed.data(), packed.size());
      return;
    }
    const bool whole =
        layout_.compression != ExrCompression::none &&
        (layout_.compression == ExrCompression::rle ? undo_runs(packed) : undo_deflate(packed));
    if (!whole) damaged(index, "is not of its length");
    restore_order();
  }

  bool undo_deflate(std::string_view packed) {
    coded_.resize(unpacked_.size());
    uLongf length = coded_.size();
    const int result =
        uncompress(coded_.data(), &length, reinterpret_cast<const Bytef*>(packed.data()), packed.size());
    return result == Z_OK && length == coded_.size();
  }

  // A count of n >= 0 repeats the next byte n + 1 times; n < 0 copies -n bytes.
  bool undo_runs(std::string_view packed) {
    coded_.clear();
    for (std::size_t i = 0; i < packed.size();) {
      const int count = static_cast<signed char>(packed[i++]);
      const std::size_t bytes = static_cast<std::size_t>(count < 0 ? -count : count + 1);
      const std::size_t needed = count < 0 ? bytes : 1;
      if (needed > packed.size() - i || bytes > unpacked_.size() - coded_.size()) return false;
      if (count < 0) {
        coded_.insert(coded_.end(), packed.begin() + static_cast<std::ptrdiff_t>(i),
                      packed.begin() + static_cast<std::ptrdiff_t>(i + bytes));
      } else {
        coded_.insert(coded_.end(), bytes, static_cast<std::uint8_t>(packed[i]));
      }
      i += needed;
    }
    return coded_.size() == unpacked_.size();
  }

  // Bytes are differences + 128, the even ones before the odd ones.
  void restore_order() {
    for (std::size_t i = 1; i < coded_.size(); ++i) {
      coded_[i] = static_cast<std::uint8_t>(coded_[i - 1] + coded_[i] - 128);
    }
    const std::size_t half = (coded_.size() + 1) / 2;
    for (std::size_t i = 0; i < coded_.size(); ++i)
      unpacked_[i] = coded_[(i & 1) == 0 ? i / 2 : half + i / 2];
  }

  // Writes the channel's values to every third float.
  void values(std::size_t line, std::size_t channel, float* to) const {
    const std::uint8_t* from = unpacked_.data() + line + channel_offset_[channel];
    const auto width = static_cast<std::size_t>(layout_.data.width());
    const bool half = layout_.channels[channel].stored == SampleType::half;
    for (std::size_t x = 0; x < width; ++x) {
      if (half) {
        std::uint16_t bits = 0;
        std::memcpy(&bits, from + 2 * x, sizeof bits);
        to[3 * x] = glm::unpackHalf1x16(bits);
      } else {
        std::memcpy(&to[3 * x], from + 4 * x, sizeof(float));
      }
    }
  }

  std::string_view bytes_;
  const ExrLayout& layout_;
  const std::filesystem::path& file_;
  std::int64_t lines_, line_bytes_ = 0;
  std::vector<std::int64_t> channel_offset_;  // within a scanline
  std::vector<std::uint8_t> unpacked_, coded_;
};

}  // namespace

void read_exr_scanlines(std::string_view bytes, const ExrLayout& layout,
                        const std::array<std::size_t, 3>& channels, const std::filesystem::path& file,
                        const ExrScanline& take) {
  ExrChunks(bytes, layout, file).each_line(channels, take);
}

}  // namespace herr
