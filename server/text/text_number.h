// A number that a text is, the same in every locale. Before: values of settings as they are written. After:
// whoever puts them in order.
#pragma once

#include <optional>
#include <string_view>

namespace herr {

// None where the whole text is no number: "4" and "0.5" are some, "acuity" and "788x384" are none.
std::optional<double> number_in(std::string_view text);

}  // namespace herr
