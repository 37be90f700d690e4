#include "server/replay/picture_output.h"

#include <chrono>
#include <cstddef>
#include <utility>

#include "server/output/contact_sheet.h"
#include "server/output/png_encoder.h"
#include "server/process/version.h"
#include "server/results/settings_report.h"
#include "sessions/files/input_error.h"

namespace herr {

PictureMetadata picture_metadata(const SessionReport& report, const ReplayOptions& options,
                                 const Pose& world_from_session) {
  PictureMetadata metadata;
  metadata.session = printable(report.name);
  metadata.scene = printable(report.scene_name);
  metadata.program = program_with_version();
  metadata.isa = name_of(report.settings.isa);
  metadata.settings = settings_text(resolved_options(options, report), report.findings.camera_rows[0] > 0);
  metadata.world_from_session = world_from_session;
  if (const auto& view = report.settings.outside) {
    const Pose& stated = view->space_from_camera;
    metadata.world_from_outside = view->space == OutsideSpace::session ? world_from_session * stated : stated;
  }
  return metadata;
}

PictureOutput::PictureOutput(Config config, const FrameFiles& files, Renderer& renderer, FrameWriter& writer)
    : config_(std::move(config)), names_(files), renderer_(renderer), writer_(writer) {
  files_.resize(files.files_per_frame());
  if (config_.formats.has(PictureFormat::png)) pictures_.resize(config_.pictures.size());
}

ParallelFor PictureOutput::parallel_for() {
  return [this](int count, const std::function<void(int)>& work) { renderer_.parallel_for(count, work); };
}

void PictureOutput::encode_pngs(const std::vector<const ViewportImage*>& rendered, Cost& cost) {
  const std::size_t first = names_.first_of(PictureFormat::png);
  renderer_.parallel_for(static_cast<int>(pictures_.size()), [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    srgb8_from_viewport(*rendered[index], config_.with_alpha, pictures_[index]);
    encode_png(pictures_[index], files_[first + index]);
  });
  cost.nonfinite_values = 0;
  for (const Srgb8Image& picture : pictures_) {
    cost.nonfinite_values += picture.nonfinite_values;
    cost.clipped_pixels += picture.clipped_pixels;
  }
}

void PictureOutput::encode_one_exr(const std::vector<const ViewportImage*>& rendered,
                                   const FrameSample& sample, Cost& cost) {
  cost.nonfinite_values = encode_exr(rendered, config_.pictures, sample, config_.metadata, parallel_for(),
                                     files_[names_.first_of(PictureFormat::exr)]);
}

std::int64_t PictureOutput::bytes_held() const {
  std::int64_t sum = bytes_of(sheet_.values) + bytes_of(sheet_file_);
  for (const Srgb8Image& picture : pictures_) sum += bytes_of(picture.values);
  for (const std::vector<std::uint8_t>& file : files_) sum += bytes_of(file);
  return sum;
}

PictureOutput::Cost PictureOutput::write_frame(std::int64_t frame, const FrameSample& sample,
                                               const RenderedFrame& rendered) {
  Cost cost;
  const std::optional<std::filesystem::path> contact_sheet = names_.contact_sheet(frame);
  const std::vector<const ViewportImage*> pictures = rendered.pictures();
  // Encode everything first: that is what write_ms measures.
  const auto start = std::chrono::steady_clock::now();
  config_.metadata.frame = frame;
  // Both find the same values that are not finite: they count once.
  if (config_.formats.has(PictureFormat::png)) encode_pngs(pictures, cost);
  if (config_.formats.has(PictureFormat::exr)) encode_one_exr(pictures, sample, cost);
  if (contact_sheet) {
    draw_contact_sheet(pictures, config_.pictures, parallel_for(), sheet_);
    encode_png(sheet_, sheet_file_);
  }
  const auto encoded = std::chrono::steady_clock::now();
  cost.encode_ms = std::chrono::duration<double, std::milli>(encoded - start).count();

  // Then hand the bytes over.
  for (std::size_t i = 0; i < files_.size(); ++i) {
    cost.wait_ms += writer_.submit(names_.file(frame, i), files_[i]);
  }
  if (contact_sheet) cost.wait_ms += writer_.submit(*contact_sheet, sheet_file_);
  return cost;
}

}  // namespace herr
