// GET /: what runs and how fast. The numbers stand in the page as it is sent; its script (page/page.js) keeps
// them, the pictures and the charts up to date, and without scripts it reloads itself.
// Before: ServeSnapshot. After: a browser.
#pragma once

#include <string>

#include "server/serve/serve_board.h"
#include "server/settings/replay_options.h"

namespace herr {

// Files and answers of this server alone, and pictures that the script has fetched from it.
inline constexpr const char* kPagePolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

// `text` with &, <, >, " and ' as entities.
std::string html_escaped(const std::string& text);

// `polar`: has pictures of the polar buffers; null: there are none.
std::string start_page(const ServeSnapshot& snapshot, const ReplayOptions& options, TimeNs now_ns,
                       const ServedPictures* polar);

}  // namespace herr
