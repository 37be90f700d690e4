// Which files belong to a frame of a replay: what the writer makes, and what a resumed run looks for.
// Before: OutputFolder and the options. After: PictureOutput, earlier_frames.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/further_view.h"
#include "server/results/output_folder.h"
#include "server/settings/frame_range.h"
#include "server/settings/replay_options.h"

namespace herr {

class FrameFiles {
 public:
  // `pictures` as pictures_of_frame() lists them.
  FrameFiles(const OutputFolder& folder, const ReplayOptions& options,
             const std::vector<PictureOutline>& pictures, const FrameRange& range);

  // Of all formats, contact sheets aside.
  std::size_t files_per_frame() const { return suffixes_.size(); }
  // The number of the first file of a format that the run keeps: of PNG one for each picture, as they are
  // listed, of EXR one.
  std::size_t first_of(PictureFormat format) const { return first_[static_cast<std::size_t>(format)]; }
  // `index` < files_per_frame().
  std::filesystem::path file(std::int64_t frame, std::size_t index) const;
  // None for frames without a contact sheet.
  std::optional<std::filesystem::path> contact_sheet(std::int64_t frame) const;

 private:
  OutputFolder folder_;
  std::vector<std::string> suffixes_;
  std::array<std::size_t, kPictureFormats.size()> first_{};
  SheetChoice sheet_;
  std::int64_t sheet_frame_;
};

}  // namespace herr
