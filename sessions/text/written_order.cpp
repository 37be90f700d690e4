#include "sessions/text/written_order.h"

#include <cmath>

#include "sessions/text/plain_values.h"

namespace herr {
namespace {

constexpr double kLeastFirst = 0.7, kZero = 1e-4;

std::string shown(const std::array<double, 4>& q) {
  std::string text;
  for (const double number : q) text += (text.empty() ? "[" : ", ") + plain_number_text(number);
  return text + "]";
}

}  // namespace

std::optional<OrderDoubt> order_doubt(const std::array<double, 4>& q) {
  if (!(q[0] >= kLeastFirst && std::abs(q[3]) < kZero)) return std::nullopt;
  // The same half turn with its signs turned round no longer looks w-first.
  const std::array half_turn{0.0 - q[0], 0.0 - q[1], 0.0 - q[2], 0.0 - q[3]};
  return OrderDoubt{"is " + shown(q) + ", which looks w-first",
                    "here w is last: write " + shown({q[1], q[2], q[3], q[0]}) +
                        ", or where half a turn is meant " + shown(half_turn)};
}

}  // namespace herr
