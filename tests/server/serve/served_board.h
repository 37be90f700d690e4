// The endpoints of `herr serve` behind a real socket, with a board that the test fills.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "server/http/http_server.h"
#include "server/serve/endpoints.h"
#include "tests/server/http/http_client.h"

namespace herr {

using nlohmann::json;

inline constexpr TimeNs kSecondNs = 1'000'000'000;

class Serve : public ::testing::Test {
 protected:
  Serve()
      : endpoints_(
            options_, board_, [this] { return server_ ? server_->counters() : HttpCounters{}; },
            [this] { return now_ns_; }) {
    options_.clock = ReplayClock::realtime;
    HttpServer::Config config;
    config.slow_prefix = kPicturePrefix;
    server_ = std::make_unique<HttpServer>(config, [this](const HttpRequest& r) { return endpoints_(r); });
  }

  Reply get(const std::string& target) const { return herr::get(server_->port(), target); }
  json get_json(const std::string& target) const {
    const Reply reply = get(target);
    EXPECT_EQ(reply.status, 200) << target;
    EXPECT_EQ(reply.header("Content-Type"), "application/json") << target;
    return json::parse(reply.body);
  }

  std::shared_ptr<SessionReport> subject() const {
    auto report = std::make_shared<SessionReport>();
    report->name = "walk <b>&\"x\"";
    report->scene_name = "general";
    report->profile = xr1_profile();
    report->profile.viewports[0].width_px = 1000;
    report->profile.viewports[0].height_px = 600;
    report->range.count = 120;
    report->plan.entries = {{"mirror rays", true, "2 of 20 instances reflect"}};
    return report;
  }

  // Frames 1 ... count, one every 100 ms until now; frame i takes i milliseconds.
  void publish(std::int64_t count, ServePhase phase = ServePhase::running) {
    ServeSnapshot snapshot;
    snapshot.phase = phase;
    snapshot.started_ns = now_ns_ - 20 * kSecondNs;
    snapshot.taken_ns = now_ns_;
    snapshot.subject = subject();
    snapshot.rendered = count;
    snapshot.memory = {{"textures", 1000}, {"loaded textures", 500}};
    snapshot.frame = 59;
    for (std::int64_t i = 1; i <= count; ++i) {
      RecentFrame frame;
      frame.sequence = i;
      frame.finished_ns = now_ns_ - (count - i) * kSecondNs / 10;
      frame.record.frame = i;
      frame.record.times.frame_ms = static_cast<double>(i);
      frame.record.period_ms = 16.5;
      frame.record.gaze_in_head[1] = {0.6, 0.0, -0.8};
      frame.record.cpu_ms = 1.5 * static_cast<double>(i);
      frame.record.times[Stage::first_hits] = static_cast<double>(i);
      frame.record.missed = i % 2 == 0;
      frame.record.over_ms = frame.record.missed ? static_cast<double>(i) - 16.5 : 0;
      if (frame.record.missed)
        frame.record.cause = i % 4 == 0     ? MissCause::machine
                             : i % 20 == 10 ? MissCause::both
                                            : MissCause::work;
      frame.record.preemptions = i % 4 == 0 ? 7 : 0;
      frame.record.decision = {{4, 400, 128}, QualityReason::steady, 19.5, 20.0};
      if (i % 2 == 0) frame.record.misregistration_arcmin = 30;
      frame.record.dropped_frames = 1;
      if (i % 2 == 0) frame.record.motion_to_photon_ms = 20;
      snapshot.recent.push_back(frame);
      snapshot.run.add(frame.record);
    }
    board_.snapshot.set(std::make_shared<const ServeSnapshot>(std::move(snapshot)));
  }

  void publish_pictures(std::int64_t sequence, bool polar = true) {
    auto pictures = std::make_shared<ServedPictures>();
    pictures->sequence = sequence;
    const std::shared_ptr<SessionReport> of = subject();
    of->plan.polar = polar;
    pictures->subject = of;
    for (const Viewport& viewport : pictures->subject->profile.viewports) {
      ViewportImage& image = pictures->frame.viewports.emplace_back();
      image.resize(viewport.width_px, viewport.height_px);
    }
    board_.pictures.set(pictures);
  }

  ReplayOptions options_;
  ServeBoard board_;
  TimeNs now_ns_ = 1000 * kSecondNs;
  Endpoints endpoints_;
  std::unique_ptr<HttpServer> server_;
};

}  // namespace herr
