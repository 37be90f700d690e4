#include "sessions/pictures/openimageio/png_writer.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "sessions/pictures/openimageio/problem.h"

namespace herr {
namespace {

// Hands what the writer writes, always at the end, to the caller's `append`.
class Sink final : public OIIO::Filesystem::IOProxy {
 public:
  explicit Sink(const PngRequest& request) : IOProxy("", Write), request_(request) {}
  const char* proxytype() const override { return "herr_sink"; }
  std::size_t write(const void* bytes, std::size_t count) override {
    full_ = full_ || !request_.append(request_.user, bytes, count);
    if (full_) return 0;
    m_pos += static_cast<std::int64_t>(count);
    return count;
  }
  // The PNG writer ignores what write() returns.
  bool full() const { return full_; }

 private:
  const PngRequest& request_;
  bool full_ = false;
};

bool encode(const PngRequest& request, std::string& message) {
  Sink sink(request);  // outlives the output
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png", &sink);
  if (!output) throw std::runtime_error("PNG encoder: " + OIIO::geterror());
  OIIO::ImageSpec spec(request.width_px, request.height_px, request.channels, OIIO::TypeDesc::UINT8);
  spec.attribute("png:compressionLevel", request.level);
  spec.attribute("oiio:ColorSpace", std::string("sRGB"));
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const bool written = output->open("memory.png", spec) &&
                       output->write_image(OIIO::TypeDesc::UINT8, request.values) && output->close();
  message = output->geterror();
  if (sink.full()) throw std::bad_alloc();
  return written && message.empty();
}

}  // namespace

bool encode_png_picture(const PngRequest* request, PictureProblem* problem) noexcept {
  return guarded(*problem, [&] {
    std::string message;
    if (encode(*request, message)) return true;
    report(*problem, PictureProblem::bad_picture, message.empty() ? "unknown failure" : message);
    return false;
  });
}

}  // namespace herr
