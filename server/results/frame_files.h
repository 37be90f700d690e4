// Which files belong to a frame of a replay: what the writer makes, and what a resumed run looks for.
// Before: OutputFolder and the options. After: PictureOutput, earlier_frames.
#pragma once

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

  std::size_t pictures_per_frame() const { return suffixes_.size(); }
  // `index` < pictures_per_frame(): with PNG as they are listed, with EXR 0.
  std::filesystem::path picture(std::int64_t frame, std::size_t index) const;
  // None for frames without a contact sheet.
  std::optional<std::filesystem::path> contact_sheet(std::int64_t frame) const;

 private:
  OutputFolder folder_;
  std::vector<std::string> suffixes_;
  SheetChoice sheet_;
  std::int64_t sheet_frame_;
};

}  // namespace herr
