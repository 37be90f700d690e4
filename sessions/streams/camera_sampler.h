// The camera frame that the headset would have had at a time, decoded when it changes, with its exposure
// pose. Before: RowStream<CameraRow> and the pose stream (read a second time). After: Session::sample.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "sessions/files/input_file.h"
#include "sessions/format/session_header.h"
#include "sessions/streams/frame_sample.h"
#include "sessions/streams/pose_sampler.h"
#include "sessions/streams/row_stream.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

// The image of a camera row, opened and checked: inside `data_folder`, readable header, the size of the
// intrinsics. Throws InputError that names the row.
InputFile checked_image(const CsvRows& rows, const CameraRow& row, const std::filesystem::path& data_folder,
                        const CameraModel& model);

class CameraSampler {
 public:
  struct Source {
    std::filesystem::path data_folder;
    const SessionHeader::Camera* camera = nullptr;  // must outlive the sampler
    bool keep_going = false;                        // hold the previous frame when one does not decode
    std::function<void(const InputError&)> on_skipped;
  };
  // `exposure_poses` interpolates; it must not be shared. Loads the picture module where there are rows;
  // throws ModuleError.
  CameraSampler(RowStream<CameraRow> rows, PoseSampler exposure_poses, Source source);

  // The newest frame with a stamp at or before t_ns, or none yet. Times must not decrease.
  // Throws InputError when it does not decode.
  std::optional<SampledCamera> at(TimeNs t_ns);

 private:
  void show(const CameraRow& row);

  RowStream<CameraRow> rows_;
  PoseSampler exposure_poses_;
  Source source_;
  std::optional<CameraRow> after_;
  std::optional<SampledCamera> shown_;
};

}  // namespace herr
