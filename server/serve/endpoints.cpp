#include "server/serve/endpoints.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "server/http/query_names.h"
#include "server/results/summary_json.h"
#include "server/serve/metrics_page.h"
#include "server/serve/page_files.h"
#include "server/serve/prometheus_text.h"
#include "server/serve/serve_json.h"
#include "server/serve/start_page.h"

namespace herr {
namespace {

// A frame that takes longer than this will not end: the largest ones take seconds.
constexpr TimeNs kStalledNs = 300'000'000'000;

HttpResponse plain(int status, std::string text) {
  HttpResponse response;
  response.status = status;
  response.body = std::move(text) + "\n";
  return response;
}

HttpResponse not_yet(const std::string& text) {
  HttpResponse response = plain(503, text);
  response.headers.emplace_back("Retry-After", "1");
  return response;
}

// Without a body: whoever saves answers keeps none that is no picture.
HttpResponse no_picture_yet(const std::string& reason) {
  HttpResponse response = not_yet(reason);
  response.headers.emplace_back("X-Herr-Reason", reason);
  response.body.clear();
  return response;
}

HttpResponse json(const nlohmann::ordered_json& document) {
  HttpResponse response;
  response.content_type = "application/json";
  response.body = json_text(document);
  return response;
}

// Is the process worth keeping: no look at anything that may be repaired from outside.
HttpResponse livez(const ServeSnapshot& snapshot, TimeNs now_ns) {
  const bool stalled = snapshot.phase == ServePhase::running && now_ns - snapshot.taken_ns > kStalledNs;
  return stalled ? plain(503, "stalled: no frame was finished for five minutes") : plain(200, "ok");
}

HttpResponse readyz(const ServeSnapshot& snapshot) {
  if (snapshot.phase == ServePhase::running) return plain(200, "ok");
  return not_yet(snapshot.phase == ServePhase::starting ? "starting: no frame yet" : "stopping");
}

std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

// A part of the page; none for another name.
std::optional<HttpResponse> page_part(const std::string& path) {
  constexpr std::string_view kFolder = "/page/";
  constexpr std::array<std::pair<std::string_view, const char*>, 4> kParts{
      {{"page.css", "text/css; charset=utf-8"},
       {"page.js", "text/javascript; charset=utf-8"},
       {"chart.js", "text/javascript; charset=utf-8"},
       {"icon.svg", "image/svg+xml"}}};
  for (const auto& [name, type] : kParts) {
    if (path != std::string(kFolder) + std::string(name)) continue;
    HttpResponse response;
    response.content_type = type;
    response.body = page_file(name);
    return response;
  }
  return std::nullopt;
}

// Of every path: what Endpoints::frames() and picture() read.
std::vector<std::string> query_names(const std::string& path) {
  if (path == "/v1/frames") return {"since", "missed"};
  if (path.starts_with(kPicturePrefix)) return {"full"};
  return {};
}

HttpResponse png_of(const ServedPictures& pictures) {
  HttpResponse response;
  response.content_type = "image/png";
  response.headers.emplace_back("X-Herr-Sequence", std::to_string(pictures.sequence));
  return response;
}

}  // namespace

Endpoints::Endpoints(const ReplayOptions& options, const ServeBoard& board,
                     std::function<HttpCounters()> http, std::function<TimeNs()> now_ns)
    : options_(options), board_(board), http_(std::move(http)), now_ns_(std::move(now_ns)) {}

HttpResponse Endpoints::operator()(const HttpRequest& request) {
  const bool of_picture = request.path.starts_with(kPicturePrefix);
  const std::string problem = query_problem(request, query_names(request.path));
  if (of_picture) return problem.empty() ? picture(request) : plain(400, problem);
  // A path that does not exist says so rather than that it has no parameters.
  HttpResponse response = document(request);
  return problem.empty() || response.status == 404 ? response : plain(400, problem);
}

HttpResponse Endpoints::document(const HttpRequest& request) {
  const std::string& path = request.path;
  const std::shared_ptr<const ServeSnapshot> snapshot = board_.snapshot.get();
  if (!snapshot) return not_yet("starting");
  const TimeNs now_ns = now_ns_();
  if (path == "/livez" || path == "/healthz") return livez(*snapshot, now_ns);
  if (path == "/readyz") return readyz(*snapshot);
  if (path == "/v1/status") return json(status_json(*snapshot, options_, now_ns));
  if (path == "/v1/latency") return json(latency_reply_json(*snapshot, options_.clock, now_ns));
  if (path == "/v1/frames") return frames(request, *snapshot);
  if (path == "/v1/plan")
    return snapshot->subject ? json(plan_reply_json(*snapshot, pictures_.bytes_held()))
                             : not_yet("no plan yet");
  if (path == "/metrics") {
    HttpResponse response;
    response.content_type = PrometheusText::kContentType;
    response.body = metrics_page(*snapshot, http_(), pictures_.bytes_held());
    return response;
  }
  if (path == "/") {
    HttpResponse response;
    response.content_type = "text/html; charset=utf-8";
    response.headers.emplace_back("Content-Security-Policy", kPagePolicy);
    // Whoever looks at the page will look at the polar buffers: its next version has them.
    board_.polar_asked_ns = now_ns;
    const std::shared_ptr<const ServedPictures> pictures = board_.pictures.get();
    response.body =
        start_page(*snapshot, options_, now_ns, pictures && pictures->has_polar ? pictures.get() : nullptr);
    return response;
  }
  if (const std::optional<HttpResponse> part = page_part(path)) return *part;
  return plain(404, "404 Not Found; / lists what is here");
}

HttpResponse Endpoints::frames(const HttpRequest& request, const ServeSnapshot& snapshot) const {
  const auto missed = request.query.find("missed");
  const bool missed_only = missed != request.query.end() && missed->second == "1";
  if (missed != request.query.end() && !missed_only && missed->second != "0")
    return plain(400, "missed: neither 0 nor 1");
  const auto since = request.query.find("since");
  if (since == request.query.end()) return json(frames_json(snapshot, 0, missed_only));
  const std::optional<std::int64_t> sequence = whole_number(since->second);
  if (!sequence) return plain(400, "since: not a whole number; give the greatest sequence that you have");
  return json(frames_json(snapshot, *sequence, missed_only));
}

HttpResponse Endpoints::polar_picture(const ServedPictures& pictures, std::size_t eye) {
  if (!pictures.subject->plan.polar) return plain(404, "404 no polar buffer: foveation is off");
  board_.polar_asked_ns = now_ns_();
  if (!pictures.has_polar) return no_picture_yet("the next frame will have it");
  HttpResponse response = png_of(pictures);
  response.body = pictures_.polar_png(pictures, eye);
  return response;
}

HttpResponse Endpoints::picture(const HttpRequest& request) {
  const std::string_view name =
      std::string_view(request.path).substr(std::string_view(kPicturePrefix).size());
  const auto full = request.query.find("full");
  if (full != request.query.end() && full->second != "0" && full->second != "1") {
    return plain(400, "full: neither 0 nor 1");
  }
  const std::shared_ptr<const ServedPictures> pictures = board_.pictures.get();
  if (!pictures) return no_picture_yet("no frame yet");
  for (std::size_t eye = 0; eye < kPolarPictures.size(); ++eye) {
    if (name == std::string(kPolarPictures[eye]) + ".png") return polar_picture(*pictures, eye);
  }
  const std::vector<PictureOutline> outlines = pictures->subject->pictures();
  const auto found = std::find_if(outlines.begin(), outlines.end(), [&](const PictureOutline& outline) {
    return outline.name + ".png" == name;
  });
  if (found == outlines.end())
    return plain(404,
                 "404 no such picture; /v1/status lists them under profile.viewports and, where there are "
                 "any, further_views");
  HttpResponse response = png_of(*pictures);
  response.body = pictures_.png(*pictures, static_cast<std::size_t>(found - outlines.begin()),
                                full != request.query.end() && full->second == "1");
  return response;
}

}  // namespace herr
