// The newest frame's pictures as PNG files for people who look in: reduced to 512 pixels or in full size,
// each encoded at most once for a frame and only when somebody asks.
// Before: ServedPictures of the board. After: GET /v1/frames/latest/{picture}.png.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "server/output/srgb_table.h"
#include "server/serve/serve_board.h"

namespace herr {

inline constexpr int kReducedPicturePx = 512;
// Names of the polar buffers' pictures, per eye; no other picture has them.
inline constexpr std::array<const char*, 2> kPolarPictures{"polar-left", "polar-right"};

// Thread-safe; one caller encodes while the others wait. Call it on a thread of low priority.
class LatestPicture {
 public:
  // The bytes of the PNG of picture `index` of the frame. Without a camera feed the full size has alpha,
  // the reduced one a dark background.
  std::string png(const ServedPictures& pictures, std::size_t index, bool full);
  // Of the polar buffer of eye 0 or 1, over the feed as a dark grey. `pictures` must have it.
  std::string polar_png(const ServedPictures& pictures, std::size_t eye);
  std::int64_t encoded() const;  // in all
  // Files and the 8-bit picture that they are made of. Does not wait for one that is being encoded.
  std::int64_t bytes_held() const { return bytes_held_; }

 private:
  struct Encoded {
    std::int64_t sequence = 0;
    std::string bytes;
  };
  // `draw` fills image_ unless the picture is encoded already.
  std::string encode_once(Encoded& encoded, std::int64_t sequence, const std::function<void()>& draw);

  mutable std::mutex mutex_;
  std::array<Encoded, 2> polar_cache_;
  std::map<std::pair<std::size_t, bool>, Encoded> cache_;
  Srgb8Image image_;
  std::vector<std::uint8_t> bytes_;
  std::int64_t encoded_ = 0;
  std::atomic<std::int64_t> bytes_held_ = 0;
};

}  // namespace herr
