#include "server/results/frame_files.h"

namespace herr {

FrameFiles::FrameFiles(const OutputFolder& folder, const ReplayOptions& options,
                       const std::vector<PictureOutline>& pictures, const FrameRange& range)
    : folder_(folder),
      sheet_(options.sheet),
      sheet_frame_(options.sheet == SheetChoice::middle ? range.middle() : options.sheet_frame) {
  for (const PictureFormat format : kPictureFormats) {
    first_[static_cast<std::size_t>(format)] = suffixes_.size();
    if (!options.formats.has(format)) continue;
    if (format == PictureFormat::exr) suffixes_.push_back(".exr");
    if (format != PictureFormat::png) continue;
    for (const PictureOutline& picture : pictures) suffixes_.push_back("." + picture.name + ".png");
  }
}

std::filesystem::path FrameFiles::file(std::int64_t frame, std::size_t index) const {
  return folder_.picture(frame, suffixes_.at(index));
}

std::optional<std::filesystem::path> FrameFiles::contact_sheet(std::int64_t frame) const {
  const bool wanted = sheet_ == SheetChoice::all || (sheet_ != SheetChoice::none && frame == sheet_frame_);
  if (!wanted) return std::nullopt;
  return folder_.contact_sheet(frame);
}

}  // namespace herr
