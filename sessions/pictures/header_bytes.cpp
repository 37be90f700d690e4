#include "sessions/pictures/header_bytes.h"

#include <algorithm>
#include <utility>

namespace herr {

HeaderBytes::HeaderBytes(InputFile& file)
    : path_(file.path()), file_(&file), size_bytes_(static_cast<std::size_t>(file.size_bytes())) {}

HeaderBytes::HeaderBytes(std::filesystem::path path, std::string_view whole)
    : path_(std::move(path)), whole_(whole), size_bytes_(whole.size()) {}

std::string_view HeaderBytes::first(std::size_t count) {
  if (file_ == nullptr) return whole_.substr(0, count);
  if (const std::size_t had = read_.size(); count > had) {
    read_.resize(std::min(count, size_bytes_));
    read_.resize(had + file_->read(read_.data() + had, read_.size() - had));
  }
  return std::string_view(read_).substr(0, count);
}

}  // namespace herr
