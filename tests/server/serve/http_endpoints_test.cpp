// Every path of `herr serve`, over a real socket, with a board that the test fills.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "server/serve/prometheus_text.h"
#include "server/serve/recycler.h"
#include "tests/missing_tool.h"
#include "tests/server/serve/served_board.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

// Width and height stand in bytes 16 ... 23 of every PNG.
std::pair<int, int> png_size(const std::string& file) {
  if (file.size() < 24 || file.substr(1, 3) != "PNG") return {0, 0};
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value * 256 + static_cast<unsigned char>(file[i]);
    return value;
  };
  return {number(16), number(20)};
}

TEST_F(Serve, BeforeTheFirstFrameItIsAliveAndNotReady) {
  for (const bool opened : {false, true}) {
    if (opened) publish(0, ServePhase::starting);
    if (!opened) board_.snapshot.set(std::make_shared<const ServeSnapshot>());
    EXPECT_EQ(get("/livez").status, 200);
    EXPECT_EQ(get("/readyz").status, 503);
    EXPECT_EQ(get("/readyz").header("Retry-After"), "1");
    EXPECT_EQ(get("/").status, 200);
    EXPECT_EQ(get("/metrics").status, 200);
    for (const char* name : {"left_context", "polar-left"}) {
      const Reply early = get(std::string("/v1/frames/latest/") + name + ".png");
      EXPECT_EQ(early.status, 503);
      EXPECT_EQ(early.body, "") << "nobody saves it as a picture";
      EXPECT_EQ(early.header("Retry-After"), "1");
      EXPECT_EQ(early.header("X-Herr-Reason"), "no frame yet");
    }
    EXPECT_EQ(get_json("/v1/status")["phase"], "starting");
    EXPECT_TRUE(get_json("/v1/latency")["run"]["frame"]["p50"].is_null());
    EXPECT_EQ(get_json("/v1/frames")["frames"].size(), 0u);
  }
}

TEST_F(Serve, HealthFollowsThePhase) {
  publish(5);
  EXPECT_EQ(get("/readyz").status, 200);
  EXPECT_EQ(get("/healthz").status, 200);
  publish(5, ServePhase::stopping);
  EXPECT_EQ(get("/readyz").status, 503);
  EXPECT_EQ(get("/livez").status, 200);
  publish(5);
  now_ns_ += 301 * kSecondNs;
  EXPECT_EQ(get("/livez").status, 503) << "no frame for five minutes";
}

TEST_F(Serve, StatusAndLatencyAgreeWithTheSnapshot) {
  publish(150);
  const json status = get_json("/v1/status");
  EXPECT_EQ(status["sequence"], 150);
  EXPECT_EQ(status["uptime_s"], 20.0);
  EXPECT_EQ(status["clock"], "realtime");
  EXPECT_EQ(status["replay"]["progress"], 0.5);  // frame 59 of 0 ... 119
  EXPECT_EQ(status["run"]["frames"]["missed"], 75);
  EXPECT_EQ(status["run"]["frames"]["dropped"], 150);
  for (const auto& [name, count] : status["run"]["frames"].items()) {
    EXPECT_TRUE(status["definitions"][name].is_string()) << name;
  }
  EXPECT_EQ(status["profile"]["viewports"].size(), 4u);
  // Ten a second for ten seconds: frames 51 ... 150.
  EXPECT_EQ(status["window"]["frames"]["rendered"], 100);
  EXPECT_EQ(status["window"]["frames_per_s"], 10.0);

  const json latency = get_json("/v1/latency");
  EXPECT_EQ(latency["run"]["frame"]["count"], 150);
  EXPECT_EQ(latency["run"]["frame"]["max"], 150.0);
  EXPECT_EQ(latency["run"]["motion_to_photon"]["count"], 75);
  EXPECT_EQ(latency["window"]["frame"]["count"], 100);
  EXPECT_EQ(latency["window"]["frame"]["min"], 51.0);
  EXPECT_EQ(latency["window"]["frame"]["mean"], 100.5);
  // The 50th of 51 ... 150 is 100, within 0.5 %.
  EXPECT_NEAR(latency["window"]["frame"]["p50"].get<double>(), 100, 0.5);
  EXPECT_EQ(latency["window"]["stages"].size(), kStageCount);
  EXPECT_EQ(latency["window"]["quality"]["reasons"], json({{"steady", 100}}));
  EXPECT_EQ(latency["window"]["quality"]["polar_width"]["p50"], 400.0);
  EXPECT_EQ(latency["window"]["feed"]["misregistration"]["count"], 50);
  EXPECT_EQ(latency["window"]["feed"]["misregistration"]["max"], 30.0);
  // The slowest of 100 frames took 150 ms.
  EXPECT_NEAR(latency["window"]["pace"]["low_1_percent_mean_fps"].get<double>(), 1000 / 150.0, 1e-9);
  for (const char* name :
       {"missed", "dropped", "repeated", "presentation_time", "motion_to_photon", "window", "polar_width",
        "misregistration", "feed_turn", "feed_shift", "stutter_frames", "stutter_share_of_time",
        "low_1_percent_rank_fps", "low_1_percent_mean_fps", "low_1_percent_time_fps"}) {
    EXPECT_TRUE(latency["definitions"].contains(name)) << name;
  }
}

TEST_F(Serve, FurtherViewsAreListedAndShownLikeViewports) {
  const std::shared_ptr<SessionReport> of = subject();
  of->settings.blended_view = Blend::context;
  ServeSnapshot snapshot;
  snapshot.phase = ServePhase::running;
  snapshot.subject = of;
  snapshot.rendered = 1;
  board_.snapshot.set(std::make_shared<const ServeSnapshot>(snapshot));
  const json views = get_json("/v1/status")["further_views"];
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[1]["name"], "blended-right");
  EXPECT_NE(get("/").body.find("/v1/frames/latest/blended-left.png"), std::string::npos);

  auto pictures = std::make_shared<ServedPictures>();
  pictures->sequence = 1;
  pictures->subject = of;
  for (const PictureOutline& outline : of->pictures()) {
    ViewportImage image;
    image.resize(outline.width_px, outline.height_px);
    if (outline.kind == PictureKind::blended) {
      pictures->frame.further.push_back({outline.name, image});
    } else {
      pictures->frame.viewports.push_back(image);
    }
  }
  board_.pictures.set(pictures);
  // As large as the context of its eye, which the board's profile has at 1000 x 600 and 1980 x 1980.
  EXPECT_EQ(png_size(get("/v1/frames/latest/blended-left.png?full=1").body), std::make_pair(1000, 600));
  EXPECT_EQ(png_size(get("/v1/frames/latest/blended-right.png").body), std::make_pair(512, 512));
  EXPECT_EQ(get("/v1/frames/latest/blended-up.png").status, 404);
}

TEST_F(Serve, FramesSinceASequenceComeOnceAndInOrder) {
  publish(50);
  std::int64_t since = 0, seen = 0;
  const json all = get_json("/v1/frames?since=0");
  for (const json& frame : all["frames"]) {
    EXPECT_EQ(frame["sequence"], ++seen);
    EXPECT_EQ(frame["frame_ms"], static_cast<double>(seen));
    EXPECT_EQ(frame["period_ms"], 16.5);
    EXPECT_EQ(frame["gaze_in_head"]["right"], json({0.6, 0.0, -0.8}));
    EXPECT_EQ(frame["motion_to_photon_ms"].is_null(), seen % 2 == 1);
    EXPECT_EQ(frame["misregistration_arcmin"].is_null(), seen % 2 == 1);
    EXPECT_EQ(frame["polar_width"], 400);
    EXPECT_EQ(frame["light_samples"], 4);
    EXPECT_EQ(frame["quality_reason"], "steady");
    EXPECT_EQ(frame["quality_predicted_ms"], 19.5);
    since = frame["sequence"];
  }
  EXPECT_EQ(seen, 50);
  EXPECT_EQ(get_json("/v1/frames?since=" + std::to_string(since))["frames"].size(), 0u);
  EXPECT_EQ(get_json("/v1/frames?since=47")["frames"].size(), 3u);
  EXPECT_EQ(get_json("/v1/frames?since=9223372036854775807")["frames"].size(), 0u);
  for (const char* wrong : {"-1", "18446744073709551616", "x", "", "1e3", "5%00"}) {
    EXPECT_EQ(get(std::string("/v1/frames?since=") + wrong).status, 400) << wrong;
  }
  publish(3000);
  const json first = get_json("/v1/frames");
  EXPECT_EQ(first["frames"].size(), 1000u);
  EXPECT_EQ(first["more"], true);
  EXPECT_EQ(get_json("/v1/frames?since=2000")["more"], false);
}

// Frames 2, 4, 6 ... missed; of these every second one for the machine, 10, 30 and 50 for both, the others,
// 25 - 12 - 3, for the work.
TEST_F(Serve, LateFramesSayWhetherTheMachineOrTheWorkMadeThemLate) {
  publish(50);
  const json late = get_json("/v1/frames?missed=1");
  ASSERT_EQ(late["frames"].size(), 25u);
  EXPECT_EQ(late["newest"], 50);
  EXPECT_EQ(late["more"], false);
  for (const json& frame : late["frames"]) {
    const auto number = frame["frame"].get<int>();
    EXPECT_EQ(number % 2, 0);
    EXPECT_EQ(frame["cause"], number % 4 == 0 ? "machine" : number % 20 == 10 ? "both" : "work");
    EXPECT_EQ(frame["preemptions"], number % 4 == 0 ? 7 : 0);
    EXPECT_EQ(frame["cpu_ms"], 1.5 * number) << "beside the wall time";
    EXPECT_EQ(frame["over_ms"], number - 16.5);
    // First hits take 1 ... 50 ms: their median is 25, within 0.5 %. No other stage took any time.
    EXPECT_EQ(frame["stage"], number > 25 ? json("first_hits") : json()) << number;
  }
  EXPECT_TRUE(get_json("/v1/frames?missed=0")["frames"][0]["over_ms"].is_null());
  EXPECT_TRUE(get_json("/v1/frames?missed=0")["frames"][0]["stage"].is_null());
  EXPECT_TRUE(get_json("/v1/frames?missed=0")["frames"][0]["cause"].is_null()) << "frame 1 was in time";
  EXPECT_EQ(get_json("/v1/frames?missed=0")["frames"].size(), 50u);
  EXPECT_EQ(get_json("/v1/frames?missed=1&since=45")["frames"].size(), 3u);
  EXPECT_EQ(get("/v1/frames?missed=yes").status, 400);
  EXPECT_EQ(get_json("/v1/status")["run"]["frames"]["missed_by_machine"], 12);
  EXPECT_EQ(get_json("/v1/status")["run"]["frames"]["missed_by_both"], 3);
  EXPECT_EQ(get_json("/v1/status")["run"]["frames"]["missed_by_work"], 10);
  EXPECT_NE(get("/metrics").body.find("herr_frames_missed_by_machine_total 12\n"), std::string::npos);
  EXPECT_NE(get("/metrics").body.find("herr_frames_missed_by_both_total 3\n"), std::string::npos);
  const std::string page = get("/").body;
  for (const char* part : {"Late frames, 25 in the last 10 s", "<td>75.00</td><td>0</td><td>both</td>",
                           "<td>69.00</td><td>0</td><td>work</td>",
                           "<td>72.00</td><td>7</td><td>machine</td>", "/v1/frames?missed=1"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  publish(4000);
  const json many = get_json("/v1/frames?missed=1");
  EXPECT_EQ(many["frames"].size(), 1000u);
  EXPECT_EQ(many["more"], true);
}

TEST_F(Serve, ThePlanSaysWhatRunsAndWhy) {
  publish(1);
  const json plan = get_json("/v1/plan")["plan"];
  EXPECT_EQ(plan[0]["name"], "mirror rays");
  EXPECT_EQ(plan[0]["runs"], true);
  EXPECT_EQ(plan[0]["reason"], "2 of 20 instances reflect");
  EXPECT_TRUE(get_json("/v1/plan")["probes"].is_null()) << "the plan has no probes";
}

TEST_F(Serve, ThePlanSaysHowTheProbesOfTheLastFrameFare) {
  ServeSnapshot snapshot;
  snapshot.phase = ServePhase::running;
  auto report = subject();
  report->plan.probes = true;
  snapshot.subject = report;
  FrameRecord record;
  record.counters.rays[RayKind::primary] = 5000;
  record.counters.rays[RayKind::probe] = 900;
  snapshot.run.add(record);
  record.probes = {
      .active = 700, .relocated = 30, .inactive = 1348, .updated = 256, .reacting = 2, .variability = 0.125};
  record.counters.rays[RayKind::probe] = 400, record.counters.rays[RayKind::probe_shadow] = 300;
  record.counters.rays[RayKind::catcher_probe] = 20;
  record.counters.rays[RayKind::catcher_probe_shadow] = 2;
  snapshot.run.add(record);
  snapshot.rendered = 2;
  board_.snapshot.set(std::make_shared<const ServeSnapshot>(std::move(snapshot)));
  const json probes = get_json("/v1/plan")["probes"];
  EXPECT_EQ(probes["active"], 700);
  EXPECT_EQ(probes["relocated"], 30);
  EXPECT_EQ(probes["inactive"], 1348);
  EXPECT_EQ(probes["updated_per_frame"], 256);
  EXPECT_EQ(probes["reacting"], 2);
  EXPECT_EQ(probes["rays_per_frame"], 811);  // of probes only: (900 + 0 + 0 + 400 + 300 + 20 + 2) / 2
  EXPECT_EQ(probes["variability"], 0.125);
}

TEST_F(Serve, PicturesAreReducedAndEncodedOncePerFrame) {
  publish(1);
  publish_pictures(1);
  const Reply reduced = get("/v1/frames/latest/left_context.png");
  EXPECT_EQ(reduced.status, 200);
  EXPECT_EQ(reduced.header("Content-Type"), "image/png");
  EXPECT_EQ(reduced.header("X-Herr-Sequence"), "1");
  // 1000 x 600 to 512 x 307.2.
  EXPECT_EQ(png_size(reduced.body), std::make_pair(512, 307));
  for (int i = 0; i < 5; ++i) EXPECT_EQ(get("/v1/frames/latest/left_context.png").body, reduced.body);
  EXPECT_EQ(endpoints_.pictures().encoded(), 1);
  EXPECT_EQ(png_size(get("/v1/frames/latest/left_context.png?full=1").body), std::make_pair(1000, 600));
  EXPECT_EQ(endpoints_.pictures().encoded(), 2);
  publish_pictures(2);
  EXPECT_EQ(get("/v1/frames/latest/left_context.png").header("X-Herr-Sequence"), "2");
  EXPECT_EQ(endpoints_.pictures().encoded(), 3);
  for (const char* name :
       {"left", "left_context", "left_context.jpg", "", "../status", "a/left_context.png"}) {
    EXPECT_EQ(get(std::string("/v1/frames/latest/") + name).status, 404) << name;
  }
  EXPECT_NE(get("/v1/frames/latest/third.png").body.find("lists them under profile.viewports"),
            std::string::npos);
  EXPECT_EQ(get("/v1/frames/latest/left_context.png?full=yes").status, 400);
}

TEST_F(Serve, OnlyExactPathsExist) {
  publish(1);
  for (const char* path : {"//", "/v1", "/v1/", "/v1/status/", "/metrics/x", "/LIVEZ", "/livez%00",
                           "/%2e%2e/etc/passwd", "/v1/frames/latest"}) {
    EXPECT_EQ(get(path).status, 404) << path;
  }
}

// What promtool does not look for: series twice, families in pieces, buckets that fall, no bucket for all.
TEST_F(Serve, MetricsAreSoundText) {
  publish(100);
  const Reply reply = get("/metrics");
  EXPECT_EQ(reply.header("Content-Type"), "text/plain; version=0.0.4; charset=utf-8");
  ASSERT_TRUE(reply.body.ends_with("\n"));
  EXPECT_EQ(reply.body.find('\r'), std::string::npos);
  std::set<std::string> series, families;
  std::map<std::string, double> values;
  std::string family, type, line;
  double last_bucket = 0;
  std::istringstream lines(reply.body);
  while (std::getline(lines, line)) {
    if (line.starts_with("# HELP ")) {
      family = line.substr(7, line.find(' ', 7) - 7);
      EXPECT_TRUE(families.insert(family).second) << line;
      continue;
    }
    if (line.starts_with("# TYPE ")) {
      ASSERT_TRUE(line.starts_with("# TYPE " + family + " ")) << line;
      type = line.substr(line.rfind(' ') + 1);
      EXPECT_EQ(type == "counter", family.ends_with("_total")) << line;
      continue;
    }
    ASSERT_TRUE(line.starts_with(family)) << line;
    const std::string name = line.substr(0, line.rfind(' '));
    const double value = std::strtod(line.c_str() + line.rfind(' ') + 1, nullptr);
    EXPECT_TRUE(series.insert(name).second) << "twice: " << line;
    EXPECT_TRUE(std::isfinite(value)) << line;
    values[name] = value;
    if (type != "histogram") continue;
    const bool bucket = name.starts_with(family + "_bucket");
    if (name.find("le=\"0.002\"") != std::string::npos) last_bucket = 0;
    if (bucket) {
      EXPECT_GE(value, last_bucket) << line;
      last_bucket = value;
    }
    // _count follows the buckets; the last of them was +Inf.
    if (name.starts_with(family + "_count")) {
      EXPECT_EQ(value, last_bucket) << line;
    }
  }
  EXPECT_EQ(values["herr_frames_rendered_total"], 100);
  EXPECT_EQ(values["herr_frames_missed_deadline_total"], 50);
  EXPECT_EQ(values["herr_frame_duration_seconds_count"], 100);
  // 1 + 2 + ... + 100 ms.
  EXPECT_NEAR(values["herr_frame_duration_seconds_sum"], 5.05, 1e-9);
  EXPECT_EQ(values["herr_frame_duration_seconds_bucket{le=\"+Inf\"}"], 100);
  // 1 ... 50 ms; 50 ms itself lies in the bound's bucket.
  EXPECT_EQ(values["herr_frame_duration_seconds_bucket{le=\"0.05\"}"], 50);
  EXPECT_EQ(values["herr_ready"], 1);
  // 1.5 + 3 + ... + 150 ms.
  EXPECT_NEAR(values["herr_frame_cpu_seconds_sum"], 7.575, 1e-9);
  EXPECT_EQ(values["herr_memory_bytes{part=\"textures\"}"], 1000);
  EXPECT_EQ(values["herr_memory_bytes{part=\"loaded textures\"}"], 500);
  EXPECT_GE(values["herr_usable_cores"], 1);
  EXPECT_GE(values["herr_peak_resident_memory_bytes"], values["process_resident_memory_bytes"] - (1 << 20));
}

TEST_F(Serve, TheLoadOfTheMachineIsTold) {
  publish(100);
  const json load = get_json("/v1/status")["load"];
  EXPECT_NEAR(load["cpu"]["mean"].get<double>(), 75.75, 1e-6);  // 7575 / 100 ms
  // Frames take 50.5 ms on average, two thirds of that.
  EXPECT_NEAR(load["cpu_share"].get<double>() * load["cores"].get<int>(), 1.5, 1e-6);
  EXPECT_GT(load["peak_resident_bytes"].get<std::int64_t>(), 1 << 20);
  EXPECT_EQ(get_json("/v1/latency")["run"]["load"]["cpu"]["count"], 100);
  EXPECT_EQ(get_json("/v1/frames")["frames"][1]["cpu_ms"], 3.0);
  json memory = get_json("/v1/plan")["memory_bytes"];
  EXPECT_EQ(memory["encoder buffers"], 0) << "nobody has asked for a picture";
  EXPECT_EQ(memory["together"], 1500);
  publish_pictures(100);
  const std::string png = get("/v1/frames/latest/left_context.png").body;
  memory = get_json("/v1/plan")["memory_bytes"];
  // The file, kept, and the 8-bit picture that it was made of.
  EXPECT_GE(memory["encoder buffers"].get<std::size_t>(), png.size() + 3 * 512 * 307);
  EXPECT_EQ(memory["together"].get<std::int64_t>(), 1500 + memory["encoder buffers"].get<std::int64_t>());
}

TEST_F(Serve, PromtoolFindsNothingInTheMetrics) {
  const char* named = std::getenv("HERR_PROMTOOL");
  const std::string promtool = named != nullptr ? named : "promtool";
  if (std::system((promtool + " --version >/dev/null 2>&1").c_str()) != 0) {
    HERR_MISSING_TOOL("no promtool; apt-get install prometheus, or set HERR_PROMTOOL");
  }
  publish(100);
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "metrics").string();
  std::ofstream(file) << get("/metrics").body;
  EXPECT_EQ(std::system((promtool + " check metrics <'" + file + "'").c_str()), 0);
}

TEST(PrometheusText, EscapesLabelsAndWritesNumbersAsGoDoes) {
  PrometheusText text;
  text.family("a", "gauge", "back\\slash\nline");
  text.sample(0.1, {{"x", "q\"b\\n\n"}});
  text.sample(std::nan(""));
  text.sample(HUGE_VAL, {{"y", "1"}});
  EXPECT_EQ(
      text.text(),
      "# HELP a back\\\\slash\\nline\n# TYPE a gauge\na{x=\"q\\\"b\\\\n\\n\"} 0.1\na NaN\na{y=\"1\"} +Inf\n");
}

TEST(Recycler, GivesStorageBackOnceTheLastReaderIsGone) {
  Recycler<std::string> recycler;
  auto first = recycler.take();
  const std::string* storage = first.get();
  std::shared_ptr<const std::string> reader = first;
  first.reset();
  EXPECT_NE(recycler.take().get(), storage) << "still read";
  reader.reset();
  // Two are spare now; the one given back last comes first.
  EXPECT_EQ(recycler.take().get(), storage);
}

}  // namespace
}  // namespace herr
