#include "server/convert/convert_report.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/text/number_text.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

// Entries of a list in session.json, and bytes of one.
constexpr std::size_t kMostRecorded = 64, kLongestRecorded = 1000;

std::string shown(const std::filesystem::path& path) {
  return printable(path.string());
}

struct CountedRemark {
  std::string key, sentence;
  std::int64_t count = 0, first_line = 0;
};

// Counts that are not 0, by what they mean.
std::vector<CountedRemark> remarks_of(const ImportedStream& stream, bool is_gaze) {
  std::vector<CountedRemark> found;
  const auto add = [&](std::string key, std::string sentence, std::int64_t count, std::int64_t line) {
    if (count > 0) found.push_back({std::move(key), std::move(sentence), count, line});
  };
  for (std::size_t i = 0; i < kRowFates; ++i) {
    const RowFateText& text = row_fate_texts()[i];
    const bool lost_gaze = is_gaze && i == static_cast<std::size_t>(RowFate::lost_tracking);
    add(std::string(text.key),
        lost_gaze ? "rows without gaze (blinks, lost pupils), written as not valid"
                  : std::string(text.sentence),
        stream.fates.rows[i], stream.fates.first_line[i]);
  }
  add("one_eye_rows", "rows with one eye only", stream.one_eye_rows, 0);
  add("repeated_values", "rows repeat the one before", stream.repeated_values, 0);
  add("sorted_rows", "rows came late and were put where they belong", stream.sorted_rows, 0);
  add("normalised_rows", "rows normalised: the length was off by more than rounding",
      stream.reading.normalised, 0);
  add("repeated_headers", "lines name the columns again and were passed over", stream.source.repeated_headers,
      0);
  add("ragged_rows", "rows have more or fewer fields than the header names", stream.source.ragged_rows, 0);
  add("blank_lines", "blank lines", stream.source.blank_lines, 0);
  return found;
}

std::string stream_text(const std::string& name, const ImportedStream& stream, bool is_gaze) {
  const double seconds = static_cast<double>(stream.last_ns - stream.first_ns) * kSecondsPerNs;
  std::string text =
      name + ": " + std::to_string(stream.rows) + " rows over " + fixed_text(seconds, 2) + " s";
  if (stream.rows > 1) text += ", " + fixed_text(stream.rate_hz(), 1) + " Hz";
  if (!stream.file.empty()) text += "  (" + shown(stream.file) + ")";
  text += "\n";
  if (const std::int64_t hitches = stream.intervals.hitches(); hitches > 0)
    text += "  " + std::to_string(hitches) + " intervals of more than 1.5 times the usual one, the widest " +
            fixed_text(static_cast<double>(stream.intervals.widest_ns()) * 1e-6, 1) + " ms before line " +
            std::to_string(stream.intervals.widest_line()) + "\n";
  for (const CountedRemark& remark : remarks_of(stream, is_gaze)) {
    text += "  " + std::to_string(remark.count) + " " + remark.sentence;
    if (remark.first_line > 0)
      text += remark.count == 1 ? " (line " + std::to_string(remark.first_line) + ")"
                                : " (the first in line " + std::to_string(remark.first_line) + ")";
    text += "\n";
  }
  return text;
}

Json stream_json(const ImportedStream& stream, bool is_gaze) {
  Json json{{"file", printable(stream.file.string())},
            {"rows_read", stream.rows_read},
            {"rows", stream.rows},
            {"first_ns", stream.first_ns},
            {"last_ns", stream.last_ns},
            {"rate_hz", stream.rate_hz()},
            {"hitches", stream.intervals.hitches()},
            {"widest_interval_ns", stream.intervals.widest_ns()},
            {"widest_interval_line", stream.intervals.widest_line()},
            {"lost_share", stream.lost_share()}};
  for (std::size_t i = 0; i < kRowFates; ++i)
    json[std::string(row_fate_texts()[i].key) + "_rows"] = stream.fates.rows[i];
  for (const char* key : {"one_eye_rows", "repeated_values", "sorted_rows", "normalised_rows",
                          "repeated_headers", "ragged_rows", "blank_lines"})
    json[key] = 0;
  for (const CountedRemark& remark : remarks_of(stream, is_gaze))
    if (json.contains(remark.key)) json[remark.key] = remark.count;
  return json;
}

std::string feed_text(std::size_t camera, const FeedReport& feed) {
  std::string text = "cam" + std::to_string(camera) + ": " + std::to_string(feed.frames) + " frames from " +
                     std::to_string(feed.pictures) + " pictures; stamps: " + feed.stamps + "  (" +
                     shown(feed.folder) + ")\n";
  for (const std::string& remark : feed.remarks) text += "  " + remark + "\n";
  return text;
}

// "1 without a stamp, 2 with the stamp of another".
std::string left_out_words(const FeedReport& feed) {
  std::string words;
  const auto add = [&](std::int64_t count, const char* what) {
    if (count > 0) words += (words.empty() ? "" : ", ") + std::to_string(count) + what;
  };
  add(feed.without_stamp, " without a stamp");
  add(feed.repeated_stamps, " with the stamp of another");
  add(feed.before_zero, " with a negative stamp");
  return words;
}

std::vector<std::string> assumed_of(const ConvertReport& report) {
  std::vector<std::string> assumed = report.rows.assumed;
  for (std::size_t i = 0; i < report.feeds.size(); ++i)
    for (const std::string& sentence : report.feeds[i].assumed)
      assumed.push_back("cam" + std::to_string(i) + ": " + sentence);
  return assumed;
}

void add_left_out(const std::string& name, const ImportedStream& stream, bool is_gaze,
                  SessionConversion& record) {
  for (std::size_t i = 0; i < kRowFates && record.left_out.size() < kMostRecorded; ++i) {
    if (stream.fates.rows[i] == 0) continue;
    if (is_gaze && i == static_cast<std::size_t>(RowFate::lost_tracking)) continue;  // written as not valid
    record.left_out.push_back(
        {name, stream.fates.rows[i], stream.rows_read, std::string(row_fate_texts()[i].sentence)});
  }
}

// The first remark about a stream's clock says what its fates only count.
std::string loss_sentence(const ImportedStream& stream, const std::vector<std::string>& remarks) {
  std::int64_t lost = 0;
  std::string causes;
  for (std::size_t i = 0; i < kRowFates; ++i) {
    if (!row_fate_texts()[i].loss || stream.fates.rows[i] == 0) continue;
    lost += stream.fates.rows[i];
    causes += (causes.empty() ? "" : "; ") + std::to_string(stream.fates.rows[i]) + " " +
              std::string(row_fate_texts()[i].sentence);
  }
  for (const std::string& remark : remarks)
    if (remark.find(std::to_string(stream.rows_read) + " rows") != std::string::npos)
      return shown(stream.file) + ": " + remark;
  return shown(stream.file) + ": " + std::to_string(lost) + " of " + std::to_string(stream.rows_read) +
         " rows are not in the session: " + causes;
}

}  // namespace

SessionConversion conversion_record(const ConvertReport& report) {
  SessionConversion record;
  add_left_out("pose", report.rows.poses, false, record);
  if (report.rows.has_gaze) add_left_out("gaze", report.rows.gaze, true, record);
  for (std::size_t i = 0; i < report.feeds.size(); ++i) {
    const FeedReport& feed = report.feeds[i];
    if (feed.left_out() > 0)
      record.left_out.push_back({"cam" + std::to_string(i), feed.left_out(), feed.pictures + feed.left_out(),
                                 "pictures: " + left_out_words(feed)});
  }
  const std::vector<std::string> assumed = assumed_of(report);
  for (const auto* sentences : {&assumed, &report.rows.remarks, &report.remarks})
    for (const std::string& sentence : *sentences)
      if (record.assumed.size() < kMostRecorded)
        record.assumed.push_back(sentence.substr(0, kLongestRecorded));
  return record;
}

std::vector<std::string> heavy_losses(const ConvertReport& report) {
  std::vector<std::string> sentences;
  for (const ImportedStream* stream : {&report.rows.poses, &report.rows.gaze})
    if (stream->rows_read > 0 && stream->lost_share() > kPartialShare)
      sentences.push_back(loss_sentence(*stream, report.rows.remarks));
  for (const FeedReport& feed : report.feeds) {
    const std::int64_t all = feed.pictures + feed.left_out();
    if (static_cast<double>(feed.left_out()) > kPartialShare * static_cast<double>(all))
      sentences.push_back(shown(feed.folder) + ": " + std::to_string(feed.left_out()) + " of " +
                          std::to_string(all) + " pictures are not in the session: " + left_out_words(feed));
  }
  return sentences;
}

std::string convert_text(const ConvertReport& report) {
  std::string text = "session: " + shown(report.out) + "\nformat: " + printable(report.format) + "\n";
  if (!report.head_words.empty()) text += "head: " + report.head_words + "\n";
  if (!report.gaze_words.empty()) text += "eyes: " + report.gaze_words + "\n";
  text += stream_text("poses", report.rows.poses, false);
  if (report.rows.has_gaze)
    text +=
        stream_text(report.rows.gaze_combined ? "gaze (combined)" : "gaze (per eye)", report.rows.gaze, true);
  for (std::size_t i = 0; i < report.feeds.size(); ++i) text += feed_text(i, report.feeds[i]);
  for (const std::string& sentence : assumed_of(report)) text += "assumed: " + sentence + "\n";
  for (const auto* sentences :
       {&report.remarks, &report.rows.remarks, &report.rows.warnings, &report.warnings})
    for (const std::string& sentence : *sentences) text += "note: " + sentence + "\n";
  return text;
}

std::string convert_json(const ConvertReport& report) {
  Json json{{"session", shown(report.out)},
            {"format", printable(report.format)},
            {"head", report.head_words},
            {"eyes", report.gaze_words}};
  json["poses"] = stream_json(report.rows.poses, false);
  if (report.rows.has_gaze) {
    json["gaze"] = stream_json(report.rows.gaze, true);
    json["gaze"]["kind"] = report.rows.gaze_combined ? "combined" : "per_eye";
  }
  json["cameras"] = Json::array();
  for (const FeedReport& feed : report.feeds)
    json["cameras"].push_back({{"folder", shown(feed.folder)},
                               {"frames", feed.frames},
                               {"pictures", feed.pictures},
                               {"left_out", feed.left_out()},
                               {"stamps", feed.stamps},
                               {"remarks", feed.remarks}});
  json["shift_ns"] = report.rows.shift_ns;
  json["assumed"] = assumed_of(report);
  json["remarks"] = report.remarks;
  for (const std::string& remark : report.rows.remarks) json["remarks"].push_back(remark);
  json["warnings"] = report.rows.warnings;
  for (const std::string& warning : report.warnings) json["warnings"].push_back(warning);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace herr
