// Encodes the pictures of one frame on the render threads and hands the bytes to the writer.
// Before: Renderer::render_frame. After: FrameWriter. Formats: a PNG per picture, one EXR with a part per
// picture, or both; contact sheets as PNG.
#pragma once

#include <vector>

#include "renderer/renderer.h"
#include "server/output/exr_encoder.h"
#include "server/output/frame_writer.h"
#include "server/output/srgb_table.h"
#include "server/results/frame_files.h"
#include "server/results/session_report.h"
#include "server/settings/replay_options.h"

namespace herr {

// What the headers of a run's EXR files say of it; of a frame they say its number, beside.
PictureMetadata picture_metadata(const SessionReport& report, const ReplayOptions& options,
                                 const Pose& world_from_session);

class PictureOutput {
 public:
  struct Config {
    PictureFormats formats = PictureFormat::png;
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
    std::int64_t clipped_pixels = 0;    // of PNG files: above white or below 0; 0 without PNG
  };
  Cost write_frame(std::int64_t frame, const FrameSample& sample, const RenderedFrame& rendered);

  std::int64_t bytes_held() const;  // storage that is kept from frame to frame

 private:
  void encode_pngs(const std::vector<const ViewportImage*>& rendered, Cost& cost);
  void encode_one_exr(const std::vector<const ViewportImage*>& rendered, const FrameSample& sample,
                      Cost& cost);
  ParallelFor parallel_for();

  Config config_;
  const FrameFiles& names_;
  Renderer& renderer_;
  FrameWriter& writer_;
  std::vector<Srgb8Image> pictures_;              // per picture, with PNG; storage is kept
  std::vector<std::vector<std::uint8_t>> files_;  // as names_ numbers them
  Srgb8Image sheet_;
  std::vector<std::uint8_t> sheet_file_;
};

}  // namespace herr
