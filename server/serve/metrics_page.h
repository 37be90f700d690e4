// GET /metrics: everything that a Prometheus server should see, from one snapshot.
// Before: ServeSnapshot, counters of the HTTP server. After: prometheus_text.
#pragma once

#include <string>

#include "server/http/http_server.h"
#include "server/serve/serve_board.h"

namespace herr {

std::string metrics_page(const ServeSnapshot& snapshot, const HttpCounters& http, std::int64_t encoder_bytes);

}  // namespace herr
