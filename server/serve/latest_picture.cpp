#include "server/serve/latest_picture.h"

#include <algorithm>
#include <cmath>

#include "server/output/contact_sheet.h"
#include "server/output/png_encoder.h"

namespace herr {
namespace {

constexpr float kFeedGrey = 0.18f;  // stands for the camera feed, which a polar buffer does not have

// Texels {s, r} of a polar buffer, angle upwards, over an even feed.
void draw_polar_picture(const ViewportImage& texels, Srgb8Image& out) {
  out.width_px = texels.width_px;
  out.height_px = texels.height_px;
  out.channels = 3;
  out.nonfinite_values = out.clipped_pixels = 0;
  out.values.resize(3 * static_cast<std::size_t>(out.width_px) * static_cast<std::size_t>(out.height_px));
  const Srgb8Table& table = srgb8_of_half(texels.exposure);
  std::uint8_t* to = out.values.data();
  for (int y = out.height_px - 1; y >= 0; --y) {
    const std::uint16_t* texel = texels.row(y);
    for (int x = 0; x < out.width_px; ++x, texel += 4) {
      const float kept = kFeedGrey / texels.exposure * float_from_half(texel[3]);
      for (int c = 0; c < 3; ++c) *to++ = table[half_from_float(float_from_half(texel[c]) + kept)];
    }
  }
}

}  // namespace

std::string LatestPicture::encode_once(Encoded& encoded, std::int64_t sequence,
                                       const std::function<void()>& draw) {
  if (encoded.sequence == sequence) return encoded.bytes;
  draw();
  encode_png(image_, bytes_);
  encoded.bytes.assign(bytes_.begin(), bytes_.end());
  encoded.sequence = sequence;
  ++encoded_;
  std::size_t held = image_.values.capacity() + bytes_.capacity();
  for (const auto& [key, file] : cache_) held += file.bytes.capacity();
  for (const Encoded& file : polar_cache_) held += file.bytes.capacity();
  bytes_held_ = static_cast<std::int64_t>(held);
  return encoded.bytes;
}

std::string LatestPicture::png(const ServedPictures& pictures, std::size_t index, bool full) {
  const std::lock_guard lock(mutex_);
  return encode_once(cache_[{index, full}], pictures.sequence, [&] {
    const ViewportImage& viewport = *pictures.frame.pictures().at(index);
    if (full) {
      srgb8_from_viewport(viewport, pictures.coverage, image_);
    } else {
      draw_reduced_picture(viewport, kReducedPicturePx, image_);
    }
  });
}

std::string LatestPicture::polar_png(const ServedPictures& pictures, std::size_t eye) {
  const std::lock_guard lock(mutex_);
  return encode_once(polar_cache_.at(eye), pictures.sequence,
                     [&] { draw_polar_picture(pictures.polar.at(eye), image_); });
}

std::int64_t LatestPicture::encoded() const {
  const std::lock_guard lock(mutex_);
  return encoded_;
}

}  // namespace herr
