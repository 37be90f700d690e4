#include "server/serve/latest_picture.h"

#include "server/output/contact_sheet.h"
#include "server/output/png_encoder.h"

namespace herr {

std::string LatestPicture::png(const ServedPictures& pictures, std::size_t index, bool full) {
  const std::lock_guard lock(mutex_);
  Encoded& encoded = cache_[{index, full}];
  if (encoded.sequence != pictures.sequence) {
    const ViewportImage& viewport = pictures.frame.viewports.at(index);
    if (full) {
      srgb8_from_viewport(viewport, pictures.coverage, image_);
    } else {
      draw_reduced_picture(viewport, kReducedPicturePx, image_);
    }
    encode_png(image_, bytes_);
    encoded.bytes.assign(bytes_.begin(), bytes_.end());
    encoded.sequence = pictures.sequence;
    ++encoded_;
  }
  return encoded.bytes;
}

std::int64_t LatestPicture::encoded() const {
  const std::lock_guard lock(mutex_);
  return encoded_;
}

}  // namespace herr
