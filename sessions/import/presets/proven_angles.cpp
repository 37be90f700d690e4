#include "sessions/import/presets/proven_angles.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/rows/gaze_reader.h"
#include "sessions/import/tables/row_source.h"

namespace herr {
namespace {

constexpr std::int64_t kMostRows = 500;
constexpr double kSame = 2e-5;   // rad: six decimals of angles
constexpr double kOther = 2e-4;  // rad: a formula that is off by less is not told apart

struct FormulaTrial {
  const GazeColumns* eyes = nullptr;
  const GazeColumns* combined = nullptr;
  double square_sum = 0;  // of the angles between the combined ray and the sum of the eyes' rays
};

bool has_angles(const GazeColumns& gaze) {
  for (const DirectionColumns& ray : gaze.rays)
    if (!ray.angles) return false;
  return gaze.space != GazeSpace::world;
}

std::vector<FormulaTrial> trials_of(std::span<const GazeColumns* const> fitting) {
  std::vector<FormulaTrial> trials;
  for (const GazeColumns* eyes : fitting) {
    if (eyes->rays.size() != 2 || !has_angles(*eyes)) continue;
    for (const GazeColumns* combined : fitting) {
      if (combined->rays.size() != 1 || !has_angles(*combined)) continue;
      if (combined->rays[0].angle_kind != eyes->rays[0].angle_kind) continue;
      trials.push_back({eyes, combined});
      break;
    }
  }
  return trials;
}

// The angle between the combined ray and the sum of the eyes' rays.
double sum_deviation(const GazeRow& eyes, const GazeRow& combined) {
  const glm::dvec3 sum = eyes.head_direction[0] + eyes.head_direction[1];
  const double length = glm::length(sum);
  if (length < 1) return 0;  // eyes 120 degrees apart look at nothing
  return std::asin(std::fmin(1, glm::length(glm::cross(sum / length, combined.head_direction[0]))));
}

using TrialReaders = std::vector<std::array<GazeReader, 2>>;

// Of the current row, by each formula. Throws InputError.
void read_trials(const RowSource& rows, const TrialReaders& readers, std::vector<FormulaTrial>& trials,
                 std::int64_t& used) {
  const std::array<glm::dvec3, 2> no_eyes{};
  std::array<GazeRow, 2> row;
  ReadingCounts counts;
  for (std::size_t t = 0; t < trials.size(); ++t) {
    for (std::size_t k = 0; k < 2; ++k) readers[t][k].read(rows, nullptr, no_eyes, row[k], counts);
    if (!row[0].valid[0] || !row[0].valid[1] || !row[1].valid[0]) continue;
    const double angle = sum_deviation(row[0], row[1]);
    trials[t].square_sum += angle * angle;
    if (t == 0) ++used;
  }
}

}  // namespace

const GazeColumns* proven_angles(const std::filesystem::path& file,
                                 std::span<const GazeColumns* const> fitting) {
  std::vector<FormulaTrial> trials = trials_of(fitting);
  if (trials.size() < 2) return nullptr;
  std::vector<ColumnRef> wanted;
  for (const FormulaTrial& trial : trials)
    for (const GazeColumns* gaze : {trial.eyes, trial.combined})
      for (const ColumnRef& column : columns_of(*gaze)) wanted.push_back(column);
  const std::unique_ptr<RowSource> rows = open_rows(file, trials[0].eyes->table, wanted);
  TrialReaders readers;
  for (const FormulaTrial& trial : trials)
    readers.push_back({GazeReader(*rows, *trial.eyes), GazeReader(*rows, *trial.combined)});
  std::int64_t used = 0;
  for (std::int64_t i = 0; i < kMostRows; ++i) {
    try {
      if (!rows->next()) break;
      read_trials(*rows, readers, trials, used);
    } catch (const InputError&) {
      continue;  // the import meets it again
    }
  }
  const GazeColumns* proven = nullptr;
  for (const FormulaTrial& trial : trials) {
    const double typical = std::sqrt(trial.square_sum / static_cast<double>(used));
    if (typical <= kSame && proven == nullptr)
      proven = trial.eyes;
    else if (!(typical >= kOther))
      return nullptr;
  }
  return proven;
}

}  // namespace herr
