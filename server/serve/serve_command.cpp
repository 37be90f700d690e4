#include "server/serve/serve_command.h"

#include <atomic>
#include <cerrno>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "server/http/http_server.h"
#include "server/process/exit_code.h"
#include "server/process/steady_time.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/serve/auth_token.h"
#include "server/serve/endpoints.h"
#include "server/serve/frame_loop.h"
#include "server/settings/option_checks.h"
#include "server/statistics/late_frames.h"
#include "server/statistics/latency_table.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

std::unique_ptr<HttpServer> start_server(const ServeOptions& options, HttpHandler handler) {
  HttpServer::Config config;
  config.host = options.host;
  config.port = options.port;
  config.slow_prefix = kPicturePrefix;
  config.allowed_hosts = options.allowed_hosts;
  if (!options.auth_token_file.empty()) config.token = read_auth_token(options.auth_token_file);
  try {
    return std::make_unique<HttpServer>(std::move(config), std::move(handler));
  } catch (const BindError& error) {
    if (error.error_number() == EADDRINUSE) {
      throw TemporaryError(std::string("--port: ") + error.what() +
                           "; end the program that has it, or choose another --port (0: a free one)");
    }
    throw UsageError(std::string("--host, --port: ") + error.what() + "; choose others");
  }
}

std::string address_text(const std::string& host, int port) {
  const bool ipv6 = host.find(':') != std::string::npos;
  return "http://" + (ipv6 ? "[" + host + "]" : host) + ":" + std::to_string(port) + "/\n";
}

std::string end_text(const RunStatistics& run) {
  if (run.frames == 0) return "no frame was rendered\n";
  return counted(run.frames, "frame", "frames") + ", " + std::to_string(run.missed_frames) + " missed" +
         causes_text(run) + ", " + std::to_string(run.dropped_frames) + " dropped, " +
         counted(run.repeated_ticks, "tick", "ticks") + " repeated\n\n" + latency_table(run);
}

}  // namespace

int run_serve(const ServeOptions& options) {
  check_render_settings(options.replay.render);
  ServeBoard board;
  FrameLoop loop(options.replay, board, stop_flag());
  // A request may come before it is known who counts: then nothing is counted yet.
  std::atomic<const HttpServer*> counted{nullptr};
  Endpoints endpoints(
      options.replay, board,
      [&counted] {
        const HttpServer* known = counted;
        return known != nullptr ? known->counters() : HttpCounters{};
      },
      steady_now_ns);
  // Last, so that it ends first, also when the loop throws: its threads use all that stands above.
  const std::unique_ptr<HttpServer> server =
      start_server(options, [&endpoints](const HttpRequest& request) { return endpoints(request); });
  counted = server.get();
  print_result(address_text(options.host, server->port()));

  // The server answers while the session is opened, and goes when an error ends the loop.
  loop.run();
  loop.announce_end();
  server->stop();
  print_result(end_text(loop.state().run));
  return kExitDone;
}

}  // namespace herr
