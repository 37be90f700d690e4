#include "server/replay/picture_output.h"

#include <chrono>
#include <cstddef>
#include <utility>

#include "server/output/contact_sheet.h"
#include "server/output/png_encoder.h"

namespace herr {

PictureOutput::PictureOutput(Config config, const FrameFiles& files, Renderer& renderer, FrameWriter& writer)
    : config_(std::move(config)), names_(files), renderer_(renderer), writer_(writer) {
  files_.resize(files.pictures_per_frame());
  if (config_.format != PictureFormat::png) return;
  pictures_.resize(files_.size());
}

ParallelFor PictureOutput::parallel_for() {
  return [this](int count, const std::function<void(int)>& work) { renderer_.parallel_for(count, work); };
}

void PictureOutput::encode_pngs(const std::vector<const ViewportImage*>& rendered, Cost& cost) {
  renderer_.parallel_for(static_cast<int>(pictures_.size()), [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    srgb8_from_viewport(*rendered[index], config_.with_alpha, pictures_[index]);
    encode_png(pictures_[index], files_[index]);
  });
  for (const Srgb8Image& picture : pictures_) cost.nonfinite_values += picture.nonfinite_values;
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
  if (config_.format == PictureFormat::png) encode_pngs(pictures, cost);
  if (config_.format == PictureFormat::exr) {
    cost.nonfinite_values =
        encode_exr(pictures, config_.pictures, sample, config_.metadata, parallel_for(), files_.front());
  }
  if (contact_sheet) {
    draw_contact_sheet(pictures, config_.pictures, parallel_for(), sheet_);
    encode_png(sheet_, sheet_file_);
  }
  const auto encoded = std::chrono::steady_clock::now();
  cost.encode_ms = std::chrono::duration<double, std::milli>(encoded - start).count();

  // Then hand the bytes over.
  for (std::size_t i = 0; i < files_.size(); ++i) {
    cost.wait_ms += writer_.submit(names_.picture(frame, i), files_[i]);
  }
  if (contact_sheet) cost.wait_ms += writer_.submit(*contact_sheet, sheet_file_);
  return cost;
}

}  // namespace herr
