// The files of the page at /, which are part of the program: made from the folder page/ and the packaged
// chart library when it is built (page/embed.cmake).
#pragma once

#include <string_view>

namespace herr {

// Bytes of "page.html", "page.css", "page.js", "icon.svg" or "chart.js"; empty for any other name.
std::string_view page_file(std::string_view name);

}  // namespace herr
