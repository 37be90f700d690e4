#include "scenes/environment/radiance_scanlines.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr int kShortestCoded = 8, kLongestCoded = 32767;  // pixels of a scanline with runs by component

class ScanlineReader {
 public:
  ScanlineReader(std::string_view bytes, std::size_t at, int length, const std::filesystem::path& file)
      : bytes_(bytes), at_(at), length_(static_cast<std::size_t>(length)), file_(file) {}

  void next(std::uint8_t* pixels) {
    if (length_ < kShortestCoded || length_ > kLongestCoded || !by_component()) {
      whole_pixels(pixels);
    } else {
      components(pixels);
    }
    ++scanline_;
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(file_, 0,
                     "does not decode as Radiance HDR (scanline " + std::to_string(scanline_) + " " +
                         problem + "): damaged or cut off",
                     "copy or export the picture again");
  }

  const std::uint8_t* take(std::size_t count) {
    if (count > bytes_.size() - at_) fail("ends early");
    const auto* from = reinterpret_cast<const std::uint8_t*>(bytes_.data()) + at_;
    at_ += count;
    return from;
  }

  bool by_component() const {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes_[at_ + i]); };
    return bytes_.size() - at_ >= 4 && byte(0) == 2 && byte(1) == 2 && byte(2) < 128;
  }

  void components(std::uint8_t* pixels) {
    const std::uint8_t* start = take(4);
    const std::size_t length = std::size_t{start[2]} << 8 | start[3];
    if (length != length_) fail("has " + std::to_string(length) + " pixels");
    for (std::size_t component = 0; component < 4; ++component) {
      for (std::size_t i = 0; i < length_;) {
        const std::size_t code = *take(1);
        const bool run = code > 128;
        const std::size_t count = run ? code - 128 : code;
        if (count == 0 || count > length_ - i) fail("has a run that does not fit");
        const std::uint8_t* values = take(run ? 1 : count);
        for (std::size_t k = 0; k < count; ++k) pixels[4 * (i + k) + component] = values[run ? 0 : k];
        i += count;
      }
    }
  }

  // A pixel of 1, 1, 1 repeats the one before; further such pixels are higher bytes of the count.
  void whole_pixels(std::uint8_t* pixels) {
    unsigned shift = 0;
    for (std::size_t i = 0; i < length_;) {
      const std::uint8_t* pixel = take(4);
      if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
        std::memcpy(pixels + 4 * i++, pixel, 4);
        shift = 0;
        continue;
      }
      if (i == 0 || shift > 16) fail("has a run of nothing");
      const std::size_t count = std::size_t{pixel[3]} << shift;
      if (count > length_ - i) fail("has a run that does not fit");
      for (std::size_t k = 0; k < count; ++k, ++i) std::memcpy(pixels + 4 * i, pixels + 4 * (i - 1), 4);
      shift += 8;
    }
  }

  std::string_view bytes_;
  std::size_t at_, length_;
  const std::filesystem::path& file_;
  int scanline_ = 0;
};

}  // namespace

std::vector<std::uint8_t> read_radiance_scanlines(std::string_view bytes, const RadianceHeader& header,
                                                  const std::filesystem::path& file) {
  const RadianceLayout& layout = header.layout;
  const std::size_t scanline_bytes = 4 * static_cast<std::size_t>(layout.scanline_px);
  std::vector<std::uint8_t> pixels(scanline_bytes * static_cast<std::size_t>(layout.scanlines));
  ScanlineReader reader(bytes, std::min(header.pixels_at, bytes.size()), layout.scanline_px, file);
  for (std::size_t at = 0; at < pixels.size(); at += scanline_bytes) reader.next(&pixels[at]);
  return pixels;
}

}  // namespace herr
