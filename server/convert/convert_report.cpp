#include "server/convert/convert_report.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostRecorded = SessionConversion::kMostEntries,
                      kMostRecordedBytes = SessionConversion::kMostBytes;

// Rows with a fault of their own that the text tells; the counts are of all.
constexpr std::size_t kShownRows = 5;

std::string shown(const std::filesystem::path& path) {
  return printable(path.string());
}

struct CountedRemark {
  std::string key, sentence;  // the sentence begins with the count
  std::int64_t count = 0;
  std::string lines;  // " (lines 14, 30)", or empty
};

// " (line 12)", " (lines 12, 30, 41, ...)".
std::string named_lines(const RowFateCounts& fates, std::size_t fate) {
  const auto known = std::min<std::int64_t>(fates.rows[fate], RowFateCounts::kNamedLines);
  std::string text;
  for (std::int64_t i = 0; i < known; ++i)
    text += (i > 0 ? ", " : "") + std::to_string(fates.lines[fate][static_cast<std::size_t>(i)]);
  if (fates.rows[fate] > known) text += ", ...";
  return (known == 1 ? " (line " : " (lines ") + text + ")";
}

// "3 rows left out: not readable".
std::string fate_words(std::size_t fate, std::int64_t count) {
  constexpr std::string_view kRows = "rows";  // all sentences begin so
  return counted(count, "row", "rows") + std::string(row_fate_texts()[fate].sentence.substr(kRows.size()));
}

// Counts that are not 0, by what they mean.
std::vector<CountedRemark> remarks_of(const ImportedStream& stream) {
  std::vector<CountedRemark> found;
  for (std::size_t i = 0; i < kRowFates; ++i) {
    if (stream.fates.rows[i] == 0) continue;
    const bool lost_gaze = stream.lost_rows_stay && static_cast<RowFate>(i) == RowFate::lost_tracking;
    const std::int64_t count = stream.fates.rows[i];
    found.push_back({std::string(row_fate_texts()[i].key),
                     lost_gaze ? counted(count, "row", "rows") +
                                     " without gaze (blinks, lost pupils), written as not valid"
                               : fate_words(i, count),
                     count, lost_gaze ? "" : named_lines(stream.fates, i)});
    if (!lost_gaze && static_cast<RowFate>(i) == RowFate::lost_tracking && !stream.first_absent.empty())
      found.back().lines += (count > 1 ? "; in the first, " : "; ") + stream.first_absent;
  }
  const auto add = [&](std::string key, const std::string& one, const std::string& many, std::int64_t count) {
    if (count > 0) found.push_back({std::move(key), counted(count, one, many), count, ""});
  };
  add("one_eye_rows", "row with one eye only", "rows with one eye only", stream.one_eye_rows);
  add("repeated_values", "row repeats the one before", "rows repeat the one before", stream.repeated_values);
  add("sorted_rows", "row came late and was put where it belongs",
      "rows came late and were put where they belong", stream.sorted_rows);
  add("normalised_rows", "row normalised: the length was off by more than rounding",
      "rows normalised: the length was off by more than rounding", stream.reading.normalised);
  add("repeated_headers", "line of words (headers, units) was passed over",
      "lines of words (headers, units) were passed over", stream.source.repeated_headers);
  add("ragged_rows", "row has more or fewer fields than the header names",
      "rows have more or fewer fields than the header names", stream.source.ragged_rows);
  add("blank_lines", "blank line", "blank lines", stream.source.blank_lines);
  return found;
}

std::string stream_text(const std::string& name, const ImportedStream& stream) {
  const double seconds = static_cast<double>(stream.last_ns - stream.first_ns) * kSecondsPerNs;
  std::string text =
      name + ": " + counted(stream.rows, "row", "rows") + " over " + fixed_text(seconds, 2) + " s";
  if (stream.rows > 1) text += ", " + fixed_text(stream.rate_hz(), 1) + " Hz";
  if (!stream.file.empty()) text += "  (" + shown(stream.file) + ")";
  text += "\n";
  if (const std::int64_t hitches = stream.intervals.hitches(); hitches > 0) {
    text += "  " + counted(hitches, "interval", "intervals") +
            " of more than 1.5 times the usual one, the widest " +
            fixed_text(static_cast<double>(stream.intervals.widest_ns()) * 1e-6, 1) + " ms";
    const std::int64_t line = stream.intervals.widest_line();
    text += line > 0 ? " before line " + std::to_string(line) + "\n" : "\n";
  }
  for (const CountedRemark& remark : remarks_of(stream)) text += "  " + remark.sentence + remark.lines + "\n";
  for (const std::string& remark : stream.remarks) text += "  " + remark + "\n";
  return text;
}

Json stream_json(const ImportedStream& stream) {
  Json json{{"file", printable(stream.file.string())},
            {"rows_read", stream.rows_read},
            {"rows", stream.rows},
            {"first_ns", stream.first_ns},
            {"last_ns", stream.last_ns},
            {"rate_hz", stream.rate_hz()},
            {"hitches", stream.intervals.hitches()},
            {"widest_interval_ns", stream.intervals.widest_ns()},
            {"widest_interval_line", stream.intervals.widest_line()},
            {"lost_share", stream.lost_share()},
            {"remarks", stream.remarks}};
  for (std::size_t i = 0; i < kRowFates; ++i)
    json[std::string(row_fate_texts()[i].key) + "_rows"] = stream.fates.rows[i];
  for (const char* key : {"one_eye_rows", "repeated_values", "sorted_rows", "normalised_rows",
                          "repeated_headers", "ragged_rows", "blank_lines"})
    json[key] = 0;
  for (const CountedRemark& remark : remarks_of(stream))
    if (json.contains(remark.key)) json[remark.key] = remark.count;
  return json;
}

std::string feed_text(std::size_t camera, const FeedReport& feed) {
  std::string text = "cam" + std::to_string(camera) + ": " + counted(feed.frames, "frame", "frames") +
                     " from " + counted(feed.pictures, "picture", "pictures") + "; stamps: " + feed.stamps +
                     "  (" + shown(feed.folder) + ")\n";
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

void add_left_out(const std::string& name, const ImportedStream& stream, SessionConversion& record) {
  for (std::size_t i = 0; i < kRowFates && record.left_out.size() < kMostRecorded; ++i) {
    const bool kept = stream.lost_rows_stay && static_cast<RowFate>(i) == RowFate::lost_tracking;
    if (stream.fates.rows[i] == 0 || kept) continue;
    record.left_out.push_back(
        {name, stream.fates.rows[i], stream.rows_read, std::string(row_fate_texts()[i].sentence)});
  }
}

// Cut between letters, for session.json.
std::string bounded(const std::string& sentence) {
  if (sentence.size() <= kMostRecordedBytes) return sentence;
  std::size_t end = kMostRecordedBytes - 3;
  while (end > 0 && (static_cast<unsigned char>(sentence[end]) & 0xC0) == 0x80) --end;
  return sentence.substr(0, end) + "...";
}

void add_sentences(const std::vector<std::string>& from, std::vector<std::string>& to) {
  for (const std::string& sentence : from)
    if (to.size() < kMostRecorded) to.push_back(bounded(sentence));
}

// What the clock did says more than the count of what that cost.
std::string loss_sentence(const ImportedStream& stream) {
  std::int64_t lost = 0;
  std::size_t causes = 0, clock_causes = 0;
  std::string words;
  for (std::size_t i = 0; i < kRowFates; ++i) {
    const auto fate = static_cast<RowFate>(i);
    if (stream.lost(fate) == 0) continue;
    lost += stream.lost(fate);
    ++causes;
    clock_causes += fate == RowFate::other_clock || fate == RowFate::repeated_stamp ? 1 : 0;
    words += (words.empty() ? "" : "; ") + fate_words(i, stream.fates.rows[i]) + named_lines(stream.fates, i);
  }
  if (causes == 1 && clock_causes == 1 && !stream.remarks.empty())
    return shown(stream.file) + ": " + stream.remarks.front();
  return shown(stream.file) + ": " + std::to_string(lost) + " of " + std::to_string(stream.rows_read) +
         " rows are not in the session: " + words;
}

}  // namespace

SessionConversion conversion_record(const ConvertReport& report) {
  SessionConversion record;
  add_left_out("pose", report.rows.poses, record);
  if (report.rows.has_gaze) add_left_out("gaze", report.rows.gaze, record);
  for (std::size_t i = 0; i < report.feeds.size(); ++i) {
    const FeedReport& feed = report.feeds[i];
    if (feed.left_out() > 0)
      record.left_out.push_back({"cam" + std::to_string(i), feed.left_out(), feed.pictures + feed.left_out(),
                                 "pictures: " + left_out_words(feed)});
  }
  add_sentences(assumed_of(report), record.assumed);
  add_sentences(report.remarks, record.remarks);
  add_sentences(report.rows.remarks, record.remarks);
  add_sentences(report.rows.poses.remarks, record.remarks);
  if (report.rows.gaze.remarks != report.rows.poses.remarks)
    add_sentences(report.rows.gaze.remarks, record.remarks);
  record.still_head = report.still.head;
  record.still_gaze = report.still.gaze;
  return record;
}

std::vector<std::string> heavy_losses(const ConvertReport& report) {
  std::vector<std::string> sentences;
  for (const ImportedStream* stream : {&report.rows.poses, &report.rows.gaze})
    if (stream->rows_read > 0 && stream->lost_share() > kPartialShare) {
      std::string sentence = loss_sentence(*stream);
      if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end())
        sentences.push_back(std::move(sentence));
    }
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
  text += stream_text("poses", report.rows.poses);
  if (report.rows.has_gaze)
    text += stream_text(report.rows.gaze_combined ? "gaze (combined)" : "gaze (per eye)", report.rows.gaze);
  for (std::size_t i = 0; i < report.feeds.size(); ++i) text += feed_text(i, report.feeds[i]);
  for (const std::string& sentence : assumed_of(report)) text += "assumed: " + sentence + "\n";
  for (const auto* sentences : {&report.remarks, &report.rows.remarks})
    for (const std::string& sentence : *sentences) text += "note: " + sentence + "\n";
  const std::vector<std::string>& rows = report.rows.warnings;  // one a row
  for (std::size_t i = 0; i < std::min(rows.size(), kShownRows); ++i) text += "note: " + rows[i] + "\n";
  if (rows.size() > kShownRows)
    text += "note: " +
            counted(static_cast<std::int64_t>(rows.size() - kShownRows), "more such line stands",
                    "more such lines stand") +
            " in --json\n";
  for (const std::string& sentence : report.warnings) text += "note: " + sentence + "\n";
  return text;
}

std::string convert_json(const ConvertReport& report) {
  Json json{{"session", shown(report.out)},
            {"format", printable(report.format)},
            {"head", report.head_words},
            {"eyes", report.gaze_words}};
  json["poses"] = stream_json(report.rows.poses);
  if (report.rows.has_gaze) {
    json["gaze"] = stream_json(report.rows.gaze);
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
