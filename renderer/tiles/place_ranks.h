// The sixteen places of a 4x4 block in an order: the four of each quad first. Any window of 4x4 samples holds
// each rank once.
#pragma once

#include <cstdint>

namespace herr {

constexpr std::uint8_t rank_of_place(int x, int y) {
  return static_cast<std::uint8_t>((x & 1) | (y & 1) << 1 | (x & 2) << 1 | (y & 2) << 2);
}
constexpr int column_of_rank(int rank) {
  return (rank & 1) | (rank & 4) >> 1;
}
constexpr int row_of_rank(int rank) {
  return (rank & 2) >> 1 | (rank & 8) >> 2;
}

}  // namespace herr
