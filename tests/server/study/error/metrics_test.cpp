// Tables of metrics: the error of a mean of halves, and several frames as one.
#include "server/study/error/metrics.h"

#include <gtest/gtest.h>

#include <iostream>
#include <limits>
#include <set>

#include "tests/server/study/error/error_pictures.h"

namespace herr {
namespace {

ErrorTable table_with(Metric metric, double value) {
  ErrorTable table;
  table.value[kAllPixels][static_cast<std::size_t>(metric)] = value;
  return table;
}

TEST(MetricsTest, EveryMetricHasItsOwnNameAndSaysWhatItIsInSentences) {
  std::set<std::string> names, labels;
  for (const MetricRow& row : metric_rows()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_TRUE(labels.insert(row.label).second) << row.label;
    EXPECT_EQ(std::string(row.sentence).back(), '.') << row.name;
    EXPECT_EQ(std::string(row.blind_to).back(), '.') << row.name;
  }
  EXPECT_STREQ(metric_rows()[static_cast<std::size_t>(Metric::psnr_db)].name, "psnr_db");
  EXPECT_STREQ(metric_rows()[static_cast<std::size_t>(Metric::flip)].name, "flip");
}

TEST(MetricsTest, TheErrorOfAMeanOfHalvesIsThatOfItsNoise) {
  const unsigned seed = 11;
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  // Even noise over +-0.08 around 1/2 in each half: sigma = 0.08 / sqrt 3. The mean of both errs by
  // sigma / sqrt 2. The squared difference of two such values has a mean of 2 sigma^2 and, its fourth moment
  // being 2 * 1.8 sigma^4 + 6 sigma^4, a deviation of sqrt(5.6) sigma^2: 1.2 of its mean. An RMS over 3 *
  // 64^2 values varies by 1.2 / 2 / sqrt(12288) = 0.54 %, a mean square by 1.07 %; five deviations are
  // allowed.
  const double sigma = 0.08 / std::sqrt(3.0);
  const std::vector<ViewportMap> maps = test::maps_of(test::plain_profile(64, 64, 2, 2), test::gaze_at(0));
  auto first = test::random_pictures(maps, random), second = test::random_pictures(maps, random);
  auto mean = first;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < first[0].pixels(); ++i) {
      for (auto* half : {&first, &second}) {
        float& value = (*half)[0].plane[c][i];
        value = 0.5f + 0.16f * (value - 0.5f);
      }
      mean[0].plane[c][i] = 0.5f * (first[0].plane[c][i] + second[0].plane[c][i]);
    }
  }
  const ErrorTable stated = error_of_mean(picture_errors(maps, first, second, test::on_threads(1)));
  const ErrorTable true_error =
      picture_errors(maps, mean, test::pictures_of(maps, 0.5f), test::on_threads(1));
  EXPECT_NEAR(stated.at(Metric::rmse) / (sigma / std::sqrt(2.0)), 1, 0.027);
  EXPECT_NEAR(true_error.at(Metric::rmse) / (sigma / std::sqrt(2.0)), 1, 0.027);
  EXPECT_DOUBLE_EQ(stated.at(Metric::psnr_db), -20 * std::log10(stated.at(Metric::rmse)));
  // The halves' reference is noisy: to second order 1 / (r^2 + 0.01) then adds
  // 1.4 sigma^2 (4 r^2 / 0.26^2 - 1 / 0.26) = 15.3 sigma^2 = 3.3 %, 1.4 as it goes with the difference.
  // Beside that two times five deviations.
  EXPECT_NEAR(stated.at(Metric::relative_mse) / true_error.at(Metric::relative_mse), 1, 0.14);
  // FLIP of half a difference is 0.5^0.7 of it where features do not matter.
  EXPECT_DOUBLE_EQ(error_of_mean(table_with(Metric::flip, 1)).at(Metric::flip), std::pow(0.5, 0.7));
  EXPECT_TRUE(std::isnan(error_of_mean(ErrorTable()).at(Metric::rmse)));
}

TEST(MetricsTest, EqualHalvesHaveNoErrorAndNoSignalToNoise) {
  const ErrorTable table = error_of_mean(table_with(Metric::rmse, 0));
  EXPECT_EQ(table.at(Metric::rmse), 0);
  EXPECT_TRUE(std::isnan(table.at(Metric::psnr_db)));
}

TEST(MetricsTest, FramesAreJoinedAsTheirMeasureAsks) {
  const auto joined = [](Metric metric, double a, double b) {
    const std::array<ErrorTable, 3> frames{table_with(metric, a), ErrorTable(), table_with(metric, b)};
    return over_frames(frames).at(metric);
  };
  EXPECT_DOUBLE_EQ(joined(Metric::rmse, 3, 4), std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(joined(Metric::acuity_rmse, 3, 4), std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(joined(Metric::relative_mse, 3, 4), 3.5);
  EXPECT_DOUBLE_EQ(joined(Metric::flip, 0.3, 0.4), 0.35);
  EXPECT_DOUBLE_EQ(joined(Metric::p99_9, 3, 4), 4);
  EXPECT_DOUBLE_EQ(joined(Metric::largest, 4, 3), 4);
  // From the RMSE of all, whatever the frames' own values.
  EXPECT_TRUE(std::isnan(joined(Metric::psnr_db, 30, 40)));
  const std::array<ErrorTable, 2> frames{table_with(Metric::rmse, 0.1), table_with(Metric::rmse, 0.1)};
  EXPECT_DOUBLE_EQ(over_frames(frames).at(Metric::psnr_db), 20);
  EXPECT_TRUE(std::isnan(over_frames({}).at(Metric::rmse)));
}

}  // namespace
}  // namespace herr
