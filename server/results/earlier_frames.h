// The frames that an interrupted replay finished: rows of frames.csv whose pictures exist, from the first
// frame on without a gap. Before: OutputFolder. After: replay_session goes on with the next frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/results/frame_files.h"
#include "server/settings/frame_range.h"
#include "server/statistics/frame_pace.h"
#include "server/statistics/run_statistics.h"

namespace herr {

struct EarlierFrames {
  std::int64_t next_frame = 0;  // the first one that is missing
  std::int64_t csv_bytes = 0;   // frames.csv up to there, header included; 0: no usable header
  RunStatistics statistics;
  StutterWatch stutter;  // after the last of them
  std::int64_t picture_files = 0, picture_bytes = 0, writer_waits = 0;
  std::vector<std::string> contact_sheets;  // file names
  // Why a row was not taken, one line; empty at the end of the file and where a kill cut a row off.
  std::string remark;
};

// Reads only. Throws InputError when frames.csv is there and cannot be read.
EarlierFrames read_earlier_frames(const std::filesystem::path& frames_csv, const FrameFiles& files,
                                  const FrameRange& range);

}  // namespace herr
