// What a conversion did, as text for people and as JSON. Before: run_convert. After: stdout.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/convert/feed_writer.h"
#include "sessions/format/session_header.h"
#include "sessions/import/import_report.h"

namespace herr {

struct ConvertReport {
  std::filesystem::path out;
  std::string format;  // "preset euroc, variant tumvi"
  ImportReport rows;
  StillParts still;  // nothing was recorded of them
  std::vector<FeedReport> feeds;
  std::string head_words, gaze_words;  // where the head looks, how level it is; what the eyes do
  std::vector<std::string> remarks;    // how the format was chosen, what was assumed
  std::vector<std::string> warnings;   // one line each, of the user's files
};

std::string convert_text(const ConvertReport& report);
std::string convert_json(const ConvertReport& report);

// What session.json keeps of it.
SessionConversion conversion_record(const ConvertReport& report);
// One sentence for each stream of which more than kPartialShare was lost.
std::vector<std::string> heavy_losses(const ConvertReport& report);

}  // namespace herr
