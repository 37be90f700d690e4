#include "server/statistics/latency_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace herr {
namespace {

// The slow, obvious quantile: the smallest value that ceil(q n) values do not exceed.
double exact_quantile(std::vector<std::int64_t> values, double fraction) {
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(fraction * static_cast<double>(values.size()));
  const auto index = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
  return static_cast<double>(values[index]);
}

std::vector<std::int64_t> random_durations(unsigned seed, std::size_t count, double median_ms,
                                           double spread) {
  std::mt19937_64 engine(seed);
  std::lognormal_distribution<double> distribution(std::log(median_ms * 1e6), spread);
  std::vector<std::int64_t> values(count);
  for (auto& value : values) value = static_cast<std::int64_t>(distribution(engine));
  return values;
}

LatencyHistogram histogram_of(const std::vector<std::int64_t>& values) {
  LatencyHistogram histogram;
  for (const std::int64_t value : values) histogram.add_ns(value);
  return histogram;
}

constexpr double kFractions[] = {0.0, 0.001, 0.25, 0.5, 0.9, 0.95, 0.99, 0.999, 1.0};

TEST(LatencyHistogram, QuantilesAreWithinHalfAPercentOfTheSortedValues) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    for (const double spread : {0.05, 0.5, 2.0}) {
      const auto values = random_durations(seed, 5000, 12.0, spread);
      const LatencyHistogram histogram = histogram_of(values);
      for (const double fraction : kFractions) {
        const double exact = exact_quantile(values, fraction);
        // The bound of the method is alpha; bucket bounds are doubles, off by some 1e-13 of themselves.
        EXPECT_LE(std::abs(histogram.quantile_ns(fraction) - exact),
                  exact * (LatencyHistogram::kRelativeError + 1e-9))
            << "seed " << seed << " spread " << spread << " fraction " << fraction;
      }
    }
  }
}

TEST(LatencyHistogram, EverySingleDurationInRangeIsWithinTheBoundWhenItIsTheMedianOfThree) {
  // The median of (shortest, x, longest) cannot profit from the exact minimum and maximum.
  for (double x = 1000; x < 1e11; x *= 1.00371) {
    const auto value = static_cast<std::int64_t>(x);
    const LatencyHistogram histogram = histogram_of({0, value, 200'000'000'000});
    const double estimate = histogram.quantile_ns(0.5);
    if (value <= LatencyHistogram::kLowestNs) continue;  // shares one bucket with all shorter ones
    ASSERT_LE(std::abs(estimate / static_cast<double>(value) - 1.0), LatencyHistogram::kRelativeError + 1e-9)
        << value;
  }
}

TEST(LatencyHistogram, CountSumMinAndMaxAreExact) {
  const LatencyHistogram histogram = histogram_of({3'000'001, 1'999'999, 7});
  EXPECT_EQ(histogram.count(), 3);
  EXPECT_EQ(histogram.sum_ns(), 5'000'007);
  EXPECT_EQ(histogram.min_ns(), 7);
  EXPECT_EQ(histogram.max_ns(), 3'000'001);
  EXPECT_DOUBLE_EQ(histogram.mean_ns(), 5'000'007.0 / 3.0);
}

TEST(LatencyHistogram, MergingInAnyOrderEqualsAddingEverythingToOne) {
  const auto a = random_durations(11, 700, 5, 1.0);
  const auto b = random_durations(12, 500, 50, 0.3);
  const auto c = random_durations(13, 1, 0.0001, 0.1);
  std::vector<std::int64_t> all = a;
  all.insert(all.end(), b.begin(), b.end());
  all.insert(all.end(), c.begin(), c.end());

  LatencyHistogram left = histogram_of(a);  // (a + b) + c
  left.merge(histogram_of(b));
  left.merge(histogram_of(c));
  LatencyHistogram bc = histogram_of(b);  // (c + b) + a, the inner one commuted
  LatencyHistogram right = histogram_of(c);
  right.merge(bc);
  right.merge(histogram_of(a));
  EXPECT_EQ(left, right);
  EXPECT_EQ(left, histogram_of(all));
}

TEST(LatencyHistogram, MergingWithAnEmptyOneChangesNothing) {
  const LatencyHistogram full = histogram_of({5'000'000, 6'000'000});
  LatencyHistogram merged = full;
  merged.merge(LatencyHistogram());
  EXPECT_EQ(merged, full);
  LatencyHistogram empty;
  empty.merge(full);
  EXPECT_EQ(empty, full);
}

TEST(LatencyHistogram, AnEmptyOneAnswersZero) {
  const LatencyHistogram empty;
  EXPECT_EQ(empty.count(), 0);
  EXPECT_EQ(empty.mean_ns(), 0.0);
  EXPECT_EQ(empty.quantile_ns(0.5), 0.0);
}

TEST(LatencyHistogram, DurationsOutsideTheRangeKeepTheExactMinimumAndMaximum) {
  const LatencyHistogram histogram = histogram_of({0, 0, 500, 1'000'000'000'000, 1'000'000'000'000});
  EXPECT_EQ(histogram.quantile_ns(0.5), 0.0);  // below 1 us the minimum stands for the bucket
  EXPECT_EQ(histogram.quantile_ns(0.7), 1e12);
  EXPECT_EQ(histogram.max_ns(), 1'000'000'000'000);
}

TEST(LatencyHistogram, NegativeDurationsCountAsZeroAndNanIsRefused) {
  LatencyHistogram histogram;
  histogram.add_ms(-1.0);
  EXPECT_EQ(histogram.max_ns(), 0);
  EXPECT_THROW(histogram.add_ms(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(histogram.add_ms(std::numeric_limits<double>::infinity()), std::invalid_argument);
  EXPECT_EQ(histogram.count(), 1);
}

TEST(LatencyHistogram, MillisecondsAreRoundedToWholeNanoseconds) {
  LatencyHistogram histogram;
  histogram.add_ms(1.2345678);  // 1234567.8 ns
  EXPECT_EQ(histogram.sum_ns(), 1'234'568);
}

}  // namespace
}  // namespace herr
