#include "server/results/earlier_frames.h"

#include <optional>

#include "server/results/frames_csv.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/files/line_reader.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestRow = 8192;

// Where the files of a frame are counted, or what is missing of it.
struct FoundFiles {
  std::int64_t count = 0, bytes = 0;
  std::optional<fs::path> sheet, missing;

  void look_for(const fs::path& file) {
    const FileFacts facts = facts_of(file);
    if (facts.kind != FileKind::file || facts.size_bytes == 0) {
      if (!missing) missing = file;
      return;
    }
    ++count;
    bytes += facts.size_bytes;
  }
};

FoundFiles files_of(const FrameFiles& files, std::int64_t frame) {
  FoundFiles found;
  for (std::size_t i = 0; i < files.files_per_frame(); ++i) found.look_for(files.file(frame, i));
  found.sheet = files.contact_sheet(frame);
  if (found.sheet) found.look_for(*found.sheet);
  return found;
}

// Takes the row over; false, with a remark, when it is not the whole frame that comes next.
bool take(const TextLine& line, const fs::path& csv, const FrameFiles& files, const FrameRange& range,
          EarlierFrames& earlier) {
  const std::int64_t frame = earlier.next_frame;
  const std::string again = "frames from " + std::to_string(frame) + " on are rendered again";
  const std::optional<FrameRecord> record = line.too_long ? std::nullopt : frame_record_of(line.text);
  if (!record || record->frame != frame || record->t_ns != range.time_ns(frame)) {
    const std::string problem = "is not the row of frame " + std::to_string(frame);
    earlier.remark = InputError(csv, line.number, problem, again).what();
    return false;
  }
  const FoundFiles found = files_of(files, frame);
  if (found.missing) {
    earlier.remark = InputError(*found.missing, 0, "is missing", again).what();
    return false;
  }
  earlier.statistics.add(*record);
  earlier.stutter.next_ms(record->times.frame_ms);
  earlier.picture_files += found.count;
  earlier.picture_bytes += found.bytes;
  earlier.writer_waits += record->wait_ms > 0 ? 1 : 0;
  if (found.sheet) earlier.contact_sheets.push_back(found.sheet->filename().string());
  ++earlier.next_frame;
  return true;
}

}  // namespace

EarlierFrames read_earlier_frames(const fs::path& csv, const FrameFiles& files, const FrameRange& range) {
  EarlierFrames earlier;
  earlier.next_frame = range.first;
  if (!path_exists(csv)) return earlier;
  LineReader lines(csv, kLongestRow);
  TextLine line;
  if (!lines.next(line) || !line.whole) return earlier;
  if (std::string(line.text) + "\n" != frames_csv_header()) {
    earlier.remark =
        InputError(csv, 1, "is not the header that this version writes", "all frames are rendered again")
            .what();
    return earlier;
  }
  earlier.csv_bytes = lines.offset();
  while (earlier.next_frame < range.first + range.count && lines.next(line) && line.whole) {
    if (!take(line, csv, files, range, earlier)) break;
    earlier.csv_bytes = lines.offset();
  }
  return earlier;
}

}  // namespace herr
