// One rendered frame to the bytes of one multi-part OpenEXR file, in memory: one part per picture, half
// RGBA, linear light, premultiplied, with the state of the headset as metadata. No times in the file: same
// frame, same bytes. Before: Renderer::render_frame. After: FrameWriter.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "renderer/further_view.h"
#include "renderer/viewport_image.h"
#include "sessions/session.h"

namespace herr {

// Runs work(i) for i in [0, count), in any order, perhaps at once.
using ParallelFor = std::function<void(int count, const std::function<void(int)>& work)>;

// What the header of each part says, besides the picture's own field of view.
struct PictureMetadata {
  std::int64_t frame = 0;
  std::string session, scene;
  std::string program;      // name and version
  std::string isa;          // instruction set that rendered it: pictures differ in the last bit between them
  std::string settings;     // one line; names the exposure, which stands as a number beside it
  Pose world_from_session;  // where the recording stands in the scene, whose space is world
  std::optional<Pose> world_from_outside;  // of the camera outside the headset: looks along -Z, +Y up
};

// One part for each of pictures_of_frame(), in that order; `pictures` are theirs. `out` keeps its storage.
// Parts are compressed through `parallel_for`. Throws std::runtime_error when the encoder refuses.
// Returns the number of values that are NaN or Inf (they stay in the file).
std::int64_t encode_exr(const std::vector<const ViewportImage*>& pictures,
                        const std::vector<PictureOutline>& outlines, const FrameSample& sample,
                        const PictureMetadata& metadata, const ParallelFor& parallel_for,
                        std::vector<std::uint8_t>& out);

}  // namespace herr
