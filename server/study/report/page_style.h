// The style sheet of the page: dark text on white, for a phone, a desk and paper. Before: nothing. After:
// study_page.
#pragma once

namespace herr {

extern const char* const kPageStyle;

}  // namespace herr
