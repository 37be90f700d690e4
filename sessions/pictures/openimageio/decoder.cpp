#include "sessions/pictures/openimageio/decoder.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>

#include "sessions/pictures/openimageio/problem.h"

namespace herr {

// The bytes go last: they must outlive the reader.
struct OpenPicture {
  OIIO::Filesystem::IOMemReader bytes;
  std::unique_ptr<OIIO::ImageInput> reader;
  OIIO::ImageSpec spec;
};

namespace {

SampleType type_of(const OIIO::TypeDesc& type) {
  if (type == OIIO::TypeDesc::UINT8) return SampleType::u8;
  if (type == OIIO::TypeDesc::UINT16) return SampleType::u16;
  if (type == OIIO::TypeDesc::HALF) return SampleType::half;
  if (type == OIIO::TypeDesc::FLOAT) return SampleType::f32;
  return SampleType::other;
}

OIIO::TypeDesc wanted(SampleType as) {
  switch (as) {
    case SampleType::u8:
      return OIIO::TypeDesc::UINT8;
    case SampleType::u16:
      return OIIO::TypeDesc::UINT16;
    case SampleType::f32:
      return OIIO::TypeDesc::FLOAT;
    default:
      throw std::invalid_argument("samples are read as u8, u16 or f32");
  }
}

// An EXR names its channels; the program counts on colour or grey first.
bool channels_in_order(const OIIO::ImageSpec& spec) {
  return spec.channelindex("Y") == 0 ||
         (spec.channelindex("R") == 0 && spec.channelindex("G") == 1 && spec.channelindex("B") == 2);
}

std::unique_ptr<OIIO::ImageInput> reader_of(const std::string& format) {
  // Only the reader of the verified format is made: the way by file name tries every plugin.
  constexpr const char* kFormats[] = {"jpeg", "openexr"};
  if (std::find(std::begin(kFormats), std::end(kFormats), format) == std::end(kFormats))
    throw std::invalid_argument("no picture of format " + format + " is read");
  std::unique_ptr<OIIO::ImageInput> reader = OIIO::ImageInput::create(format);
  if (!reader || !reader->supports("ioproxy"))
    throw std::runtime_error("OpenImageIO has no in-memory reader for " + format + ": " + OIIO::geterror());
  return reader;
}

}  // namespace

OpenPicture* open_picture(const char* format, const void* bytes, std::size_t count, PictureHeader* header,
                          PictureProblem* problem) noexcept {
  return guarded(*problem, [&]() -> OpenPicture* {
    std::unique_ptr<OpenPicture> picture(new OpenPicture{{bytes, count}, reader_of(format), {}});
    OIIO::ImageInput& reader = *picture->reader;
    reader.set_ioproxy(&picture->bytes);
    OIIO::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);  // else colour is multiplied by alpha
    if (!reader.open(std::string("memory.") + format, picture->spec, wishes)) {
      report(*problem, PictureProblem::bad_picture, reader.geterror());
      return nullptr;
    }
    const OIIO::ImageSpec& spec = picture->spec;
    if (std::string("openexr") == format && !channels_in_order(spec)) {
      report(*problem, PictureProblem::bad_picture, "its channels are not R, G, B or Y");
      return nullptr;
    }
    *header = {spec.width, spec.height, spec.nchannels, type_of(spec.format)};
    return picture.release();
  });
}

bool read_picture(OpenPicture* picture, SampleType as, void* samples, std::size_t capacity_bytes,
                  PictureProblem* problem) noexcept {
  return guarded(*problem, [&] {
    const OIIO::TypeDesc type = wanted(as);
    const OIIO::ImageSpec& spec = picture->spec;
    if (spec.image_pixels() * static_cast<OIIO::imagesize_t>(spec.nchannels) * type.size() != capacity_bytes)
      throw std::invalid_argument("the room for a picture's samples is not of its size");
    const bool read = picture->reader->read_image(0, 0, 0, spec.nchannels, type, samples);
    // A file that was cut off may "succeed"; the message tells.
    const std::string message = picture->reader->geterror();
    if (read && message.empty()) return true;
    report(*problem, PictureProblem::bad_picture, message.empty() ? "it was cut off" : message);
    return false;
  });
}

void close_picture(OpenPicture* picture) noexcept {
  delete picture;
}

}  // namespace herr
