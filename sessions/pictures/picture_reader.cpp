#include "sessions/pictures/picture_reader.h"

#include <cstring>
#include <new>
#include <stdexcept>
#include <utility>

#include "sessions/pictures/jpeg_decoder.h"
#include "sessions/pictures/loaded_module.h"
#include "sessions/pictures/png_decoder.h"

namespace herr {
namespace {

// Throws what is no fault of the picture: std::bad_alloc, or std::runtime_error with the library's text.
void throw_unless_bad_picture(const PictureProblem& problem) {
  if (problem.kind == PictureProblem::out_of_memory) throw std::bad_alloc();
  if (problem.kind == PictureProblem::library) throw std::runtime_error(problem.text);
}

class ModuleDecoder final : public PictureDecoder {
 public:
  ModuleDecoder(const PictureModule& module, OpenPicture* picture)
      : module_(module), picture_(picture, module.close) {}
  bool read(SampleType as, void* samples, std::size_t capacity_bytes) override {
    PictureProblem problem;
    if (module_.read(picture_.get(), as, samples, capacity_bytes, &problem)) return true;
    throw_unless_bad_picture(problem);
    problem_ = problem.text;
    return false;
  }

 private:
  const PictureModule& module_;
  std::unique_ptr<OpenPicture, void (*)(OpenPicture*) noexcept> picture_;
};

OpenedPicture open_by_module(const char* format, std::string_view bytes) {
  const PictureModule& module = picture_module();
  OpenedPicture opened;
  PictureProblem problem;
  OpenPicture* picture = module.open(format, bytes.data(), bytes.size(), &opened.header, &problem);
  if (picture != nullptr) {
    opened.decoder = std::make_unique<ModuleDecoder>(module, picture);
    return opened;
  }
  throw_unless_bad_picture(problem);
  opened.problem = problem.text;
  return opened;
}

OpenedPicture open_picture_of(const char* format, std::string_view bytes) {
  if (std::strcmp(format, "png") == 0) return open_png(bytes);
  if (std::strcmp(format, "jpeg") == 0) {
    OpenedPicture opened = open_jpeg(bytes);
    if (opened.decoder || !opened.problem.empty()) return opened;
  }
  return open_by_module(format, bytes);
}

// Grey, grey + alpha, RGB or RGBA rows to RGBA, in place from the end.
void expand_to_rgba(std::uint8_t* rgba, std::size_t pixels, std::size_t channels) {
  for (std::size_t i = pixels; i-- > 0;) {
    std::uint8_t from[4] = {0, 0, 0, 255};
    std::memcpy(from, rgba + i * channels, channels);
    const bool grey = channels <= 2;
    const std::uint8_t to[4] = {from[0], grey ? from[0] : from[1], grey ? from[0] : from[2],
                                channels == 2 ? from[1] : from[3]};
    std::memcpy(rgba + 4 * i, to, sizeof to);
  }
}

}  // namespace

PictureReader::PictureReader(const char* format, std::string_view bytes) {
  OpenedPicture opened = open_picture_of(format, bytes);
  header_ = opened.header;
  decoder_ = std::move(opened.decoder);
  problem_ = std::move(opened.problem);
}

bool PictureReader::read(SampleType as, void* samples, std::size_t capacity_bytes) {
  if (decoder_->read(as, samples, capacity_bytes)) return true;
  problem_ = decoder_->problem();
  return false;
}

bool PictureReader::read_rgba8(std::uint8_t* rgba) {
  if (header_.channels < 1 || header_.channels > 4)
    throw std::invalid_argument("a picture of this many channels is no RGBA");
  if (decoder_->writes_rgba8()) {
    if (decoder_->read_rgba8(rgba)) return true;
    problem_ = decoder_->problem();
    return false;
  }
  const auto channels = static_cast<std::size_t>(header_.channels);
  const auto pixels =
      static_cast<std::size_t>(header_.width_px) * static_cast<std::size_t>(header_.height_px);
  if (!read(SampleType::u8, rgba, pixels * channels)) return false;
  if (channels < 4) expand_to_rgba(rgba, pixels, channels);
  return true;
}

}  // namespace herr
