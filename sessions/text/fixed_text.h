// Numbers with a fixed number of decimals, the same in every locale.
#pragma once

#include <string>

namespace herr {

// Fixed notation with `decimals` digits after the point, 0 ... 20; "n/a" when not finite.
std::string fixed_text(double value, int decimals);

}  // namespace herr
