#include "renderer/foveation/edge_places.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {

double wrapped(double x) {
  return x - std::floor(x + 0.5);
}

// Of the lattice's points from (0, 0), squared.
double nearest2(int points, int step) {
  double nearest = 2;
  for (int i = 1; i < points; ++i) {
    const double x = wrapped(static_cast<double>(i) / points),
                 y = wrapped(static_cast<double>(i * step % points) / points);
    nearest = std::min(nearest, x * x + y * y);
  }
  return nearest;
}

struct Step {
  int column, row;
};

// The cells around one, nearest to a place in it first.
std::array<Step, EdgePlaces::kNeighbours> neighbours_of(const CellPlace& place) {
  std::array<Step, EdgePlaces::kNeighbours> cells{
      {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  const auto distance2 = [&](const Step& cell) {
    const double x = cell.column - place.column, y = cell.row - place.row;
    return x * x + y * y;
  };
  std::stable_sort(cells.begin(), cells.end(),
                   [&](const Step& a, const Step& b) { return distance2(a) < distance2(b); });
  return cells;
}

}  // namespace

std::vector<CellPlace> lattice_places(int count) {
  const int points = count + 1;
  int best = 1;
  for (int step = 2; step < points; ++step) {
    if (nearest2(points, step) > nearest2(points, best) + 1e-9) best = step;
  }
  std::vector<CellPlace> places;
  for (int i = 1; i < points; ++i) {
    places.push_back(
        {wrapped(static_cast<double>(i) / points), wrapped(static_cast<double>(i * best % points) / points)});
  }
  return places;
}

EdgePlaces::EdgePlaces(int max_width, int max_height, int count)
    : columns_(static_cast<std::size_t>(max_width)),
      rows_(static_cast<std::size_t>(max_height)),
      all_{0, count},
      few_{count, std::max(2, count / 4 * 2)},
      places_(lattice_places(all_.count)) {
  for (const CellPlace& place : lattice_places(few_.count)) places_.push_back(place);
  for (const CellPlace& place : places_) {
    sides_.push_back((place.column < 0 ? kLeft : kRight) | (place.row < 0 ? kAbove : kBelow));
    const auto cells = neighbours_of(place);
    for (std::size_t n = 0; n < cells.size(); ++n) {
      neighbour_column_[n].push_back(cells[n].column);
      neighbour_row_[n].push_back(cells[n].row);
    }
  }
  for (std::vector<float>* table : {&sin_theta_, &cos_theta_}) table->resize(places_.size() * columns_);
  for (std::vector<float>* table : {&sin_phi_, &cos_phi_}) table->resize(places_.size() * rows_);
}

void EdgePlaces::divide_circle(int height) {
  height_ = height;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(height); ++j) {
      const double phi = phi_from_v((static_cast<double>(j) + 0.5 + places_[k].row) / height);
      sin_phi_[k * rows_ + j] = static_cast<float>(std::sin(phi));
      cos_phi_[k * rows_ + j] = static_cast<float>(std::cos(phi));
    }
  }
}

void EdgePlaces::update(const PolarMap& map, int width, int height) {
  if (height != height_) divide_circle(height);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    for (int i = 0; i < width; ++i) {
      const double deg = map.theta_from_u((i + 0.5 + places_[k].column) / width);
      const double theta = std::min(deg, 180.0) / kDegreesPerRadian;
      const std::size_t at = k * columns_ + static_cast<std::size_t>(i);
      sin_theta_[at] = static_cast<float>(std::sin(theta));
      cos_theta_[at] = static_cast<float>(std::cos(theta));
    }
  }
}

std::int64_t EdgePlaces::bytes() const {
  std::size_t floats = 0;
  for (const auto* table : {&sin_theta_, &cos_theta_, &sin_phi_, &cos_phi_}) floats += table->capacity();
  return static_cast<std::int64_t>(floats * sizeof(float));
}

}  // namespace herr
