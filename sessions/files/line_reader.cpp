#include "sessions/files/line_reader.h"

#include <algorithm>
#include <cstring>

#include "sessions/files/input_error.h"

namespace herr {
namespace {
constexpr std::size_t kBlockBytes = 64 << 10;
}

LineReader::LineReader(const std::filesystem::path& file, std::size_t max_line_bytes)
    : file_(file), max_line_bytes_(max_line_bytes), buffer_(max_line_bytes + kBlockBytes) {
  refill();
  skip_byte_order_mark();
}

void LineReader::skip_byte_order_mark() {
  const std::string_view start(buffer_.data(), end_);
  if (start.substr(0, 2) == "\xff\xfe" || start.substr(0, 2) == "\xfe\xff")
    throw InputError(path(), 1, "is UTF-16", "save it as UTF-8");
  if (start.substr(0, 3) == "\xef\xbb\xbf") begin_ = 3;
}

// Moves the unread bytes to the front and reads on behind them; false at the end of the file.
bool LineReader::refill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  const std::size_t got = file_.read(buffer_.data() + end_, buffer_.size() - end_);
  end_ += got;
  read_bytes_ += static_cast<std::int64_t>(got);
  return got > 0;
}

bool LineReader::next(TextLine& line) {
  line = {{}, ++line_, true, false};
  std::size_t searched = 0;
  for (;;) {
    const char* start = buffer_.data() + begin_;
    const std::size_t unread = end_ - begin_;
    const void* found = std::memchr(start + searched, '\n', unread - searched);
    if (found != nullptr) {
      line.text = {start, static_cast<std::size_t>(static_cast<const char*>(found) - start)};
      break;
    }
    searched = unread;
    if (unread > max_line_bytes_) {
      line.too_long = true;  // it is read to its end, but not kept
      begin_ = end_ - 1;     // one byte stays, so that the search below goes on within one line
      searched = 0;
    }
    if (refill()) continue;
    line.text = {buffer_.data() + begin_, end_ - begin_};
    line.whole = false;
    break;
  }
  begin_ += std::min(line.text.size() + (line.whole ? 1 : 0), end_ - begin_);
  if (!line.whole && line.text.empty()) return false;
  if (line.text.size() > max_line_bytes_) line.too_long = true;
  if (line.too_long) line.text = line.text.substr(0, max_line_bytes_);
  if (line.whole && !line.text.empty() && line.text.back() == '\r') line.text.remove_suffix(1);
  return true;
}

}  // namespace herr
