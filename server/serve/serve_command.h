// `herr serve`: replays sessions in a loop behind HTTP until a signal ends it.
// Before: the command line. After: http_server, frame_loop.
#pragma once

#include "server/serve/serve_options.h"

namespace herr {

// Prints the address on stdout once the server listens, and the latency table when it ends. Returns 0 after
// SIGINT or SIGTERM. Throws UsageError, TemporaryError (the port is in use) and what the frame loop throws.
int run_serve(const ServeOptions& options);

}  // namespace herr
