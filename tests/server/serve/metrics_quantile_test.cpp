// Quantiles that Prometheus would work out from the buckets of /metrics, against those of /v1/latency.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <utility>
#include <vector>

#include "tests/server/serve/served_board.h"

namespace herr {
namespace {

struct Bucket {
  double upper_s = 0, count = 0;  // of all up to it
};

std::vector<Bucket> buckets_of(const std::string& metrics, const std::string& family) {
  std::vector<Bucket> buckets;
  std::istringstream lines(metrics);
  const std::string start = family + "_bucket{le=\"";
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(start)) continue;
    const std::string bound = line.substr(start.size(), line.find('"', start.size()) - start.size());
    buckets.push_back(
        {bound == "+Inf" ? INFINITY : std::stod(bound), std::stod(line.substr(line.rfind(' ')))});
  }
  return buckets;
}

// histogram_quantile() of Prometheus: the first bucket that holds the rank, linear within it; the highest
// finite bound where that is the bucket of all. With the bucket's bounds.
struct Estimate {
  double value, lower, upper;
};
Estimate histogram_quantile(double q, const std::vector<Bucket>& buckets) {
  const double rank = q * buckets.back().count;
  const auto found =
      std::find_if(buckets.begin(), buckets.end(), [&](const Bucket& b) { return b.count >= rank; });
  const bool first = found == buckets.begin();
  const double lower = first ? 0 : (found - 1)->upper_s, before = first ? 0 : (found - 1)->count;
  if (std::isinf(found->upper_s)) return {lower, lower, INFINITY};
  return {lower + (found->upper_s - lower) * (rank - before) / (found->count - before), lower,
          found->upper_s};
}

// Frame times around 20 ms with a long tail, as busy machines have them. A rank lies in the same bucket for
// both unless the time is so near to a bound that the histogram's own buckets (1 % wide) cannot tell.
TEST_F(Serve, QuantilesOfTheExportedBucketsAgreeWithTheLatencyReport) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 engine(seed);
    std::lognormal_distribution<double> times_ms(std::log(5.0 * seed), 0.2 * seed);
    ServeSnapshot snapshot;
    snapshot.phase = ServePhase::running;
    snapshot.started_ns = now_ns_ - 20 * kSecondNs;
    snapshot.taken_ns = now_ns_;
    snapshot.subject = subject();
    for (int i = 0; i < 2000; ++i) {
      FrameRecord record;
      record.times.frame_ms = times_ms(engine);
      snapshot.run.add(record);
    }
    board_.snapshot.set(std::make_shared<const ServeSnapshot>(std::move(snapshot)));
    const std::vector<Bucket> buckets = buckets_of(get("/metrics").body, "herr_frame_duration_seconds");
    ASSERT_EQ(buckets.size(), 16u);
    EXPECT_EQ(buckets.back().count, 2000);
    const json frame = get_json("/v1/latency")["run"]["frame"];
    for (const auto& [q, key] :
         {std::pair{0.5, "p50"}, std::pair{0.9, "p90"}, std::pair{0.95, "p95"}, std::pair{0.99, "p99"}}) {
      const Estimate estimate = histogram_quantile(q, buckets);
      const double exact_s = frame.at(key).get<double>() * 1e-3;
      constexpr double kOwnBucket = 0.015;  // 1 % of a bucket and 0.5 % of a quantile
      EXPECT_GE(exact_s, estimate.lower * (1 - kOwnBucket)) << key;
      EXPECT_LE(exact_s, estimate.upper * (1 + kOwnBucket)) << key;
      EXPECT_TRUE(estimate.value >= estimate.lower && estimate.value <= estimate.upper) << key;
    }
  }
}

}  // namespace
}  // namespace herr
