#include "sessions/pictures/picture_reader.h"

#include <new>
#include <stdexcept>

#include "sessions/pictures/loaded_module.h"

namespace herr {

void throw_unless_bad_picture(const PictureProblem& problem) {
  if (problem.kind == PictureProblem::out_of_memory) throw std::bad_alloc();
  if (problem.kind == PictureProblem::library) throw std::runtime_error(problem.text);
}

PictureReader::PictureReader(const char* format, std::string_view bytes)
    : module_(picture_module()), picture_(nullptr, module_.close) {
  PictureProblem problem;
  picture_.reset(module_.open(format, bytes.data(), bytes.size(), &header_, &problem));
  if (picture_) return;
  throw_unless_bad_picture(problem);
  problem_ = problem.text;
}

bool PictureReader::read(SampleType as, void* samples, std::size_t capacity_bytes) {
  PictureProblem problem;
  if (module_.read(picture_.get(), as, samples, capacity_bytes, &problem)) return true;
  throw_unless_bad_picture(problem);
  problem_ = problem.text;
  return false;
}

}  // namespace herr
