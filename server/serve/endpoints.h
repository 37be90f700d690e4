// Every path that the server answers, by exact match; a query with a name that the path does not have, or
// with one twice, is 400. Thread-safe: it reads the board and nothing else. Before: http_server. After: the
// pages and documents of this folder.
#pragma once

#include <functional>

#include "server/http/http_message.h"
#include "server/http/http_server.h"
#include "server/serve/latest_picture.h"
#include "server/serve/serve_board.h"
#include "server/settings/replay_options.h"

namespace herr {

// What is below it takes long: http_server gives it a lane of its own.
inline constexpr const char* kPicturePrefix = "/v1/frames/latest/";

class Endpoints {
 public:
  // All must outlive this object. `http` tells what the server has counted, `now_ns` the time.
  Endpoints(const ReplayOptions& options, const ServeBoard& board, std::function<HttpCounters()> http,
            std::function<TimeNs()> now_ns);

  HttpResponse operator()(const HttpRequest& request);

  const LatestPicture& pictures() const { return pictures_; }

 private:
  // Everything but pictures.
  HttpResponse document(const HttpRequest& request);
  HttpResponse picture(const HttpRequest& request);
  HttpResponse polar_picture(const ServedPictures& pictures, std::size_t eye);
  HttpResponse frames(const HttpRequest& request, const ServeSnapshot& snapshot) const;

  const ReplayOptions& options_;
  const ServeBoard& board_;
  const std::function<HttpCounters()> http_;
  const std::function<TimeNs()> now_ns_;
  LatestPicture pictures_;
};

}  // namespace herr
