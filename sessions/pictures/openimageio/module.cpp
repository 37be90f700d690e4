// The entry of herr_pictures.so. The files of this folder are that library and no part of the program; they
// alone know OpenImageIO.
#include <OpenImageIO/imageio.h>

#include "sessions/pictures/openimageio/decoder.h"
#include "sessions/pictures/picture_module.h"

namespace herr {
namespace {

// The library's own limits, as a second line of defence, and no threads of its own: pictures are decoded and
// encoded by the caller.
void limit_library() {
  OIIO::attribute("try_all_readers", 0);
  OIIO::attribute("limits:channels", 8);
  OIIO::attribute("limits:imagesize_MB", 2048);
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
}

constexpr PictureModule kModule{kPictureModuleVersion, sizeof(PictureModule), HERR_VERSION,
                                open_picture,          read_picture,          close_picture};

}  // namespace
}  // namespace herr

extern "C" __attribute__((visibility("default"))) const herr::PictureModule* herr_picture_module() noexcept {
  herr::limit_library();
  return &herr::kModule;
}
