#include "sessions/streams/camera_sampler.h"

#include <utility>

#include "sessions/camera/recorded_name.h"
#include "sessions/files/input_error.h"
#include "sessions/pictures/image_format.h"
#include "sessions/pictures/loaded_module.h"

namespace herr {
namespace {

std::string pixels(int width_px, int height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px);
}

}  // namespace

InputFile checked_image(const CsvRows& rows, const CameraRow& row, const std::filesystem::path& data_folder,
                        const CameraModel& model) {
  const std::string image = "image '" + printable(row.filename) + "' ";
  std::optional<InputFile> file;
  ImageSize size;
  try {
    file = open_recorded(data_folder, row.filename, "name an image inside the camera's data folder");
    size = read_image_size(*file);
  } catch (const InputError& error) {  // it knows the image, not the row that names it
    rows.fail(image + error.problem(), error.remedy());
  }
  if (size.width_px != model.width_px || size.height_px != model.height_px)
    rows.fail(image + "has " + pixels(size.width_px, size.height_px) +
                  " pixels where the intrinsics are for " + pixels(model.width_px, model.height_px),
              "correct session.json or convert the images");
  return std::move(*file);
}

CameraSampler::CameraSampler(RowStream<CameraRow> rows, PoseSampler exposure_poses, Source source)
    : rows_(std::move(rows)), exposure_poses_(std::move(exposure_poses)), source_(std::move(source)) {
  after_ = rows_.next();
  // Loaded here, so that no frame takes that time.
  if (after_ && needs_picture_module(after_->filename)) picture_module();
}

void CameraSampler::show(const CameraRow& row) {
  SampledCamera next;
  try {
    const CameraModel& model = source_.camera->model;
    // Name and size were good when the session was opened.
    const std::string remedy = "leave the session alone while it replays";
    InputFile file = open_recorded(source_.data_folder, row.filename, remedy);
    auto image = std::make_shared<CameraImage>(read_camera_image(file));
    if (image->width_px != model.width_px || image->height_px != model.height_px)
      throw InputError(file.path(), 0, "has changed its size since it was checked", remedy);
    next.image = std::move(image);
  } catch (const InputError& error) {
    if (!source_.keep_going) throw;
    if (source_.on_skipped) source_.on_skipped(error);
    return;
  }
  next.model = &source_.camera->model;
  next.stamp_ns = row.stamp_ns;
  next.world_from_camera =
      exposure_poses_.at(row.stamp_ns).world_from_head * source_.camera->head_from_camera;
  shown_ = std::move(next);
}

std::optional<SampledCamera> CameraSampler::at(TimeNs t_ns) {
  std::optional<CameraRow> newest;
  while (after_ && after_->stamp_ns <= t_ns) {
    newest = std::move(after_);
    after_ = rows_.next();
  }
  if (newest) show(*newest);
  if (shown_) shown_->age_ns = t_ns - shown_->stamp_ns;
  return shown_;
}

}  // namespace herr
