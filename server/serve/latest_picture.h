// The newest frame's viewports as PNG files for people who look in: reduced to 512 pixels or in full size,
// each encoded at most once for a frame and only when somebody asks.
// Before: ServedPictures of the board. After: GET /v1/frames/latest/{viewport}.png.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "server/output/srgb_table.h"
#include "server/serve/serve_board.h"

namespace herr {

inline constexpr int kReducedPicturePx = 512;

// Thread-safe; one caller encodes while the others wait. Call it on a thread of low priority.
class LatestPicture {
 public:
  // The bytes of the PNG of viewport `index` of `pictures`. Without a camera feed the full size has alpha,
  // the reduced one a dark background.
  std::string png(const ServedPictures& pictures, std::size_t index, bool full);
  std::int64_t encoded() const;  // in all

 private:
  struct Encoded {
    std::int64_t sequence = 0;
    std::string bytes;
  };
  mutable std::mutex mutex_;
  std::map<std::pair<std::size_t, bool>, Encoded> cache_;
  Srgb8Image image_;
  std::vector<std::uint8_t> bytes_;
  std::int64_t encoded_ = 0;
};

}  // namespace herr
