// Encodes the pictures of one frame on the render threads and hands the bytes to the writer.
// Before: Renderer::render_frame. After: FrameWriter. Formats: one EXR with a part per picture, or a PNG per
// picture; contact sheets as PNG.
#pragma once

#include <vector>

#include "renderer/renderer.h"
#include "server/output/exr_encoder.h"
#include "server/output/frame_writer.h"
#include "server/output/srgb_table.h"
#include "server/results/frame_files.h"
#include "server/settings/replay_options.h"

namespace herr {

class PictureOutput {
 public:
  struct Config {
    PictureFormat format = PictureFormat::png;
    bool with_alpha = false;               // PNG: keep the coverage (no camera feed behind the picture)
    std::vector<PictureOutline> pictures;  // as pictures_of_frame() lists them
    PictureMetadata metadata;              // `frame` is filled in for each frame
  };
  // All three must outlive this object. Loads the picture module for PNG; throws ModuleError.
  PictureOutput(Config config, const FrameFiles& files, Renderer& renderer, FrameWriter& writer);

  struct Cost {
    double encode_ms = 0;               // on the render threads
    double wait_ms = 0;                 // for room in the writer's queue
    std::int64_t nonfinite_values = 0;  // NaN or Inf found in the pictures
  };
  Cost write_frame(std::int64_t frame, const FrameSample& sample, const RenderedFrame& rendered);

  std::int64_t bytes_held() const;  // storage that is kept from frame to frame

 private:
  void encode_pngs(const std::vector<const ViewportImage*>& rendered, Cost& cost);
  ParallelFor parallel_for();

  Config config_;
  const FrameFiles& names_;
  Renderer& renderer_;
  FrameWriter& writer_;
  std::vector<Srgb8Image> pictures_;              // per picture; storage is kept
  std::vector<std::vector<std::uint8_t>> files_;  // PNG: per picture; EXR: one
  Srgb8Image sheet_;
  std::vector<std::uint8_t> sheet_file_;
};

}  // namespace herr
