#include "server/inspect/session_text.h"

#include <functional>
#include <vector>

#include "server/inspect/scene_text.h"
#include "server/inspect/time_plot.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

std::string ms_text(double ns, int decimals = 1) {
  return fixed_text(ns * 1e-6, decimals);
}

std::string table_row(const std::string& name, const std::vector<std::string>& cells, int width) {
  std::string text = left_aligned(name, 8);
  for (const std::string& cell : cells) text += right_aligned(cell, width);
  return text + "\n";
}

std::vector<const StreamSummary*> streams_of(const SessionInspection& session) {
  std::vector<const StreamSummary*> streams{&session.poses};
  if (session.gaze) streams.push_back(&*session.gaze);
  for (const std::optional<StreamSummary>& camera : session.cameras)
    if (camera) streams.push_back(&*camera);
  return streams;
}

std::string gaze_words(const SessionHeader& header) {
  if (!header.gaze_combined) return "one ray for each eye";
  if (!header.vergence_m) return "one ray for both eyes, parallel";
  return "one ray for both eyes, which meet at " + fixed_text(*header.vergence_m, 2) + " m";
}

std::string profile_words(const DisplayProfile& profile) {
  double pixels = 0;
  for (const Viewport& viewport : profile.viewports)
    pixels += static_cast<double>(viewport.width_px) * viewport.height_px;
  return printable(profile.name) + ", " + shortest_text(profile.display_hz) + " Hz, " +
         std::to_string(profile.viewports.size()) + " viewports, " + fixed_text(pixels * 1e-6, 1) + " Mpx";
}

// What a conversion did that the streams alone do not tell.
std::string conversion_text(const SessionConversion& conversion) {
  std::string text;
  for (const SessionConversion::LeftOut& part : conversion.left_out)
    text += named_line("left out", printable(part.stream) + ": " + std::to_string(part.rows) + " of " +
                                       std::to_string(part.of) + ": " + printable(part.reason));
  for (const auto* sentences : {&conversion.assumed, &conversion.remarks})
    for (const std::string& sentence : *sentences) text += named_line("converted", printable(sentence));
  return text;
}

std::string header_text_of(const InspectReport& report) {
  const SessionInspection& session = *report.session;
  const std::string folder = printable(session.folder.string());
  if (!session.header) return "session " + folder + "\n";
  const SessionHeader& header = *session.header;
  std::string text = "session " + printable(header.name) + "   (" + folder + ")\n";
  if (!header.provenance.empty()) text += named_line("provenance", printable(header.provenance));
  if (!header.licence.empty()) text += named_line("licence", printable(header.licence));
  text += conversion_text(header.conversion);
  text += named_line("display", profile_words(report.profile));
  text += named_line("gaze", gaze_words(header));
  for (std::size_t i = 0; i < header.cameras.size(); ++i) {
    const CameraModel& model = header.cameras[i].model;
    text += named_line("cam" + std::to_string(i),
                       std::to_string(model.width_px) + "x" + std::to_string(model.height_px) + " pixels");
  }
  if (header.feed_distance_m)
    text +=
        named_line("feed", "seen " + shortest_text(*header.feed_distance_m) + " m from the displayed eye");
  if (report.frames && session.span) {
    const double seconds = static_cast<double>(session.span->end_ns - session.span->start_ns) * kSecondsPerNs;
    text += named_line("replay", fixed_text(seconds, 2) + " s, " + std::to_string(report.frames->count) +
                                     " frames, from stamp " + std::to_string(session.span->start_ns));
  }
  return text;
}

std::string streams_text(const std::vector<const StreamSummary*>& streams) {
  constexpr int kWidth = 9;
  std::string text =
      "\n" + table_row("stream",
                       {"rows", "span s", "nominal", "median", "jitter", "longest", "gaps", "repeats"},
                       kWidth);
  text += table_row("", {"", "", "Hz", "Hz", "ms", "ms", "", "%"}, kWidth);
  for (const StreamSummary* stream : streams) {
    if (stream->rows < 2) {
      text += table_row(stream->name, {std::to_string(stream->rows)}, kWidth);
      continue;
    }
    const double repeats =
        100.0 * static_cast<double>(stream->repeated_values) / static_cast<double>(stream->rows - 1);
    text += table_row(stream->name,
                      {std::to_string(stream->rows), fixed_text(stream->span_s(), 2),
                       stream->nominal_hz > 0 ? fixed_text(stream->nominal_hz, 2) : "-",
                       fixed_text(stream->median_hz(), 2), ms_text(stream->intervals.jitter_ns(), 2),
                       ms_text(static_cast<double>(stream->intervals.widest_ns())),
                       std::to_string(stream->intervals.hitches()), fixed_text(repeats, 1)},
                      kWidth);
  }
  return text + "gaps: intervals of more than 1.5 medians; jitter: deviation of the others\n";
}

std::string ages_text(const std::vector<const StreamSummary*>& streams, bool span_known) {
  if (!span_known) return "";
  constexpr int kWidth = 12;
  std::string text = "\n" + table_row("age ms", {"p50", "p95", "max", "frames", "without"}, kWidth);
  for (const StreamSummary* stream : streams) {
    if (!stream->ages) continue;
    const IntervalCensus& ages = stream->ages->ages();
    const bool any = ages.intervals() > 0;
    text +=
        table_row(stream->name,
                  {any ? ms_text(ages.quantile_ns(0.5)) : "-", any ? ms_text(ages.quantile_ns(0.95)) : "-",
                   any ? ms_text(static_cast<double>(ages.widest_ns())) : "-",
                   std::to_string(stream->ages->frames()), std::to_string(stream->ages->frames_without())},
                  kWidth);
  }
  return text + "at each displayed frame, newest sample; without: none yet, or gaze lost for 2.1 s\n";
}

std::string offsets_text(const SessionInspection& session, const std::vector<const StreamSummary*>& streams) {
  if (session.poses.rows == 0 || streams.size() < 2) return "";
  constexpr int kWidth = 12;
  std::string text =
      "\n" + table_row("to pose", {"start ms", "end ms", "change ms", "known to", "drift ppm"}, kWidth);
  for (const StreamSummary* stream : streams) {
    if (stream == &session.poses || stream->rows == 0) continue;
    const StreamOffset offset = offset_to(session.poses, *stream);
    text += table_row(
        stream->name,
        {ms_text(static_cast<double>(offset.start_ns)), ms_text(static_cast<double>(offset.end_ns)),
         ms_text(static_cast<double>(offset.change_ns)), ms_text(static_cast<double>(offset.resolution_ns)),
         offset.drift_ppm ? fixed_text(*offset.drift_ppm, 0) : "-"},
        kWidth);
  }
  return text + "drift -: too small to tell, or so large that one stream started or stopped alone\n";
}

std::string vector_text(const glm::dvec3& v) {
  return "(" + fixed_text(v.x, 2) + ", " + fixed_text(v.y, 2) + ", " + fixed_text(v.z, 2) + ")";
}

// Where the head is, to place a scene before it.
std::string place_text(const HeadMeter& head) {
  if (head.median().rows() == 0) return "";
  return "\nhead: stands at " + vector_text(head.median().place_m()) + " m and looks along " +
         vector_text(head.median().forward()) +
         " in the median,\n      in the session's axes (x right, y up, z back), before world_from_session\n";
}

std::string motion_text(const SessionInspection& session) {
  const HeadMeter& head = session.head;
  if (head.turn_deg_s().count() == 0) return place_text(head);
  const LinearHistogram &turn = head.turn_deg_s(), &move = head.move_m_s();
  const glm::dvec3 box = head.upper_m() - head.lower_m();
  std::string text =
      place_text(head) + "      turns at " + fixed_text(turn.quantile(0.5), 0) + " deg/s (p50), " +
      fixed_text(turn.quantile(0.95), 0) + " (p95), " + fixed_text(turn.max(), 0) +
      " (max)\n      moves at " + fixed_text(move.quantile(0.5), 2) + " m/s (p50), " +
      fixed_text(move.quantile(0.95), 2) + " (p95), " + fixed_text(move.max(), 2) + " (max)\n      " +
      fixed_text(head.path_m(), 2) + " m of way within " + fixed_text(box.x, 2) + " x " +
      fixed_text(box.y, 2) + " x " + fixed_text(box.z, 2) + " m, " + fixed_text(head.turned_deg(), 0) +
      " degrees of turns\n      " + session.plausibility.words() + "\n";
  const GazeMeter& eyes = session.eyes;
  if (eyes.rows() == 0) return text;
  const LinearHistogram& off = eyes.eccentricity_deg();
  const std::string gaze_words = session.plausibility.gaze_words();
  return text + "gaze: " + fixed_text(off.quantile(0.5), 1) + " deg off the head's axis (p50), " +
         fixed_text(off.quantile(0.95), 1) + " (p95), " + fixed_text(off.max(), 1) +
         " (max)\n      lost in " + percentage(eyes.lost_rows(), eyes.rows()) + " of the rows (left eye " +
         percentage(eyes.lost_rows_of(0), eyes.rows()) + ", right " +
         percentage(eyes.lost_rows_of(1), eyes.rows()) + ", one or both " +
         percentage(eyes.either_lost_rows(), eyes.rows()) + "):\n      " +
         counted(eyes.blinks(), "blink", "blinks") + ", " + counted(eyes.losses(), "loss", "losses") +
         " of more than 600 ms, the longest span " + milliseconds(eyes.longest_loss_ns()) + "\n" +
         (gaze_words.empty() ? "" : "      " + gaze_words + "\n");
}

std::string plots_text(const SessionInspection& session) {
  if (!session.span || session.span->end_ns == session.span->start_ns) return "";
  const auto [start_ns, end_ns] = *session.span;
  const double seconds = static_cast<double>(end_ns - start_ns) * kSecondsPerNs;
  const auto plot = [&, start = start_ns, end = end_ns](const TimeProfile& profile, const std::string& title,
                                                        int rows, bool lost) {
    return "\n" + time_plot(profile.columns(start, end, kPlotColumns), {title, rows, lost, seconds});
  };
  std::string text;
  if (session.head.turn_deg_s().count() > 0)
    text += plot(session.head.turn_profile(), "head turns, deg/s (# mean, : peak) over s", 6, false) +
            plot(session.head.move_profile(), "head moves, m/s", 4, false);
  if (session.eyes.rows() > 0)
    text += plot(session.eyes.eccentricity_profile(),
                 "gaze eccentricity, deg off the head's axis (lost: - in part, x wholly)", 6, true);
  return text;
}

}  // namespace

std::string session_text(const InspectReport& report) {
  const SessionInspection& session = *report.session;
  std::string text = header_text_of(report);
  const bool any_rows = session.poses.rows > 0 || (session.gaze && session.gaze->rows > 0);
  if (any_rows) {
    const std::vector<const StreamSummary*> streams = streams_of(session);
    text += streams_text(streams) + ages_text(streams, session.span.has_value()) +
            offsets_text(session, streams) + motion_text(session) + plots_text(session);
  }
  return text + "\n";
}

}  // namespace herr
