// How large a picture is. Read from its header, before any pixel is decoded.
#pragma once

namespace herr {

struct ImageSize {
  int width_px = 0, height_px = 0;
};

}  // namespace herr
