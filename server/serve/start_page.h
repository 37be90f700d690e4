// GET /: what runs and how fast, readable without scripts; it reloads itself.
// Before: ServeSnapshot. After: a browser.
#pragma once

#include <string>

#include "server/replay/replay_options.h"
#include "server/serve/serve_board.h"

namespace herr {

// Only the page's own style and pictures of this server may load.
inline constexpr const char* kPagePolicy =
    "default-src 'none'; img-src 'self'; style-src 'unsafe-inline'; frame-ancestors 'none'";

// `text` with &, <, >, " and ' as entities.
std::string html_escaped(const std::string& text);

std::string start_page(const ServeSnapshot& snapshot, const ReplayOptions& options, TimeNs now_ns);

}  // namespace herr
