// Fronts made by hand, and confidences whose chances can be counted.
#include "server/study/statistics/pareto_front.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <vector>

namespace herr {
namespace {

constexpr std::uint64_t kSeed = 7;
constexpr int kDraws = 1000;

FrontCandidate exact(double error, double log_ratio) {
  return {{error}, {log_ratio}};
}

std::vector<FrontPlace> front_of(const std::vector<FrontCandidate>& candidates) {
  return pareto_front(candidates, kDraws, kSeed);
}

// Four deviations of the share of kDraws draws, which one seed of 16000 misses.
double tolerance(double chance) {
  return 4 * std::sqrt(chance * (1 - chance) / kDraws);
}

TEST(ParetoFrontTest, KeepsWhatNoOtherBeatsInBoth) {
  // By time: 3 is the fastest, 0 better and slower, 4 as good as 0 and slower still, 1 worse than 0 and
  // slower, 2 the best. 5 is as fast as 0 and worse.
  const auto places =
      front_of({exact(2, 0.1), exact(3, 0.2), exact(1, 0.5), exact(4, -0.3), exact(2, 0.3), exact(2.5, 0.1)});
  const std::vector<bool> expected{true, false, true, true, false, false};
  ASSERT_EQ(places.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(places[i].on_front, expected[i]) << i;
    EXPECT_EQ(places[i].confidence, expected[i] ? 1 : 0) << i;
  }
}

TEST(ParetoFrontTest, ExactTiesAreBothOnIt) {
  for (const FrontPlace& place : front_of({exact(2, 0.1), exact(2, 0.1)})) {
    EXPECT_TRUE(place.on_front);
    EXPECT_EQ(place.confidence, 1);
  }
}

TEST(ParetoFrontTest, ErrorsAreRootMeanSquaresAndTimesMedians) {
  // By their means (2 and 2.1) and largest values the first would win; by squares it is 10 against 8.82.
  // Medians are 0.1 and 0.2; means would be 3.4 and 0.2.
  const std::vector<FrontCandidate> by_error{{{1, 3}, {0}}, {{2.1, 2.1}, {0}}};
  EXPECT_FALSE(front_of(by_error)[0].on_front);
  EXPECT_TRUE(front_of(by_error)[1].on_front);
  const std::vector<FrontCandidate> by_time{{{1}, {0.1, 10, 0.0, 0.1}}, {{1}, {0.2, 0.2, 0.2, 0.2}}};
  EXPECT_TRUE(front_of(by_time)[0].on_front);
  EXPECT_FALSE(front_of(by_time)[1].on_front);
  // Of an even number, the middle of the two middle ones: 0.25 against 0.2.
  const std::vector<FrontCandidate> even{{{1}, {0.4, 0.1}}, {{1}, {0.2}}};
  EXPECT_FALSE(front_of(even)[0].on_front);
}

TEST(ParetoFrontTest, ClearMembersAreSureAndClearLosersAreOut) {
  // Every frame and every ratio of one lies beyond all of the other, so no draw changes the order.
  const auto places = front_of({{{1.0, 1.2, 1.1}, {0.50, 0.52, 0.48}},
                                {{2.0, 2.3, 2.2}, {0.10, 0.12, 0.11}},
                                {{2.4, 2.6, 2.5}, {0.20, 0.22, 0.21}}});
  EXPECT_EQ(places[0].confidence, 1);
  EXPECT_EQ(places[1].confidence, 1);
  EXPECT_EQ(places[2].confidence, 0);
}

TEST(ParetoFrontTest, AChanceOfFramesIsCounted) {
  // Two frames in which one has 1 and 2, the other 2 and 1: half of the draws have both frames (a tie, both
  // on the front), a quarter each the same one twice. All draws but a quarter.
  const auto places = front_of({{{1, 2}, {0}}, {{2, 1}, {0}}});
  EXPECT_TRUE(places[0].on_front);
  EXPECT_TRUE(places[1].on_front);
  EXPECT_NEAR(places[0].confidence, 0.75, tolerance(0.75));
  EXPECT_NEAR(places[1].confidence, 0.75, tolerance(0.75));
  // Squares 1, 1, 16 against 8, 8, 8: three draws sum to less than 24 with one 16 (18) and more with two
  // (33), so the first wins with (2/3)^3 + 3 (2/3)^2 (1/3) = 20/27.
  const double even = std::sqrt(8.0);
  const auto three = front_of({{{1, 1, 4}, {0}}, {{even, even, even}, {0}}});
  EXPECT_NEAR(three[0].confidence, 20.0 / 27, tolerance(20.0 / 27));
  EXPECT_NEAR(three[1].confidence, 7.0 / 27, tolerance(7.0 / 27));
}

TEST(ParetoFrontTest, AChanceOfRatiosIsCounted) {
  // The median of three draws from -1, -1, 1 is -1 with (2/3)^3 + 3 (2/3)^2 (1/3) = 20/27. That of two from
  // -1.3 and 1.1 is -1.3, -0.1 and 1.1 with 1/4, 1/2 and 1/4; it lies above 0 with 1/4.
  const auto three = front_of({{{1}, {-1, -1, 1}}, exact(1, 0)});
  EXPECT_NEAR(three[0].confidence, 20.0 / 27, tolerance(20.0 / 27));
  EXPECT_NEAR(three[1].confidence, 7.0 / 27, tolerance(7.0 / 27));
  const auto two = front_of({{{1}, {-1.3, 1.1}}, exact(1, 0)});
  EXPECT_NEAR(two[0].confidence, 0.75, tolerance(0.75));
}

TEST(ParetoFrontTest, APairThatIsAsLikelyEitherWayIsOnItHalfOfTheTime) {
  // The second has the first's errors of the other half of the frames, so that each draw has a mirror image
  // with the order reversed; 50 irregular differences never cancel.
  FrontCandidate one{{}, {0}}, other{{}, {0}};
  const auto error = [](int i) { return 1 + 0.3 * std::sin(i * i); };
  for (int i = 0; i < 100; ++i) {
    one.frame_errors.push_back(error(i));
    other.frame_errors.push_back(error((i + 50) % 100));
  }
  const auto places = front_of({one, other});
  std::cout << "seed " << kSeed << ": " << places[0].confidence << "\n";
  EXPECT_NEAR(places[0].confidence, 0.5, tolerance(0.5));
  EXPECT_DOUBLE_EQ(places[0].confidence + places[1].confidence, 1);
}

TEST(ParetoFrontTest, FramesAreDrawnForAllAlike) {
  // A hard frame is hard for both; the second is a tenth worse in each.
  const auto places = front_of({{{1, 100, 2, 1}, {0}}, {{1.1, 110, 2.2, 1.1}, {0}}});
  EXPECT_EQ(places[0].confidence, 1);
  EXPECT_EQ(places[1].confidence, 0);
}

TEST(ParetoFrontTest, CandidatesWithoutErrorsOrRatiosAreNeverOnItAndBeatNothing) {
  const auto places = front_of({{{}, {-5}}, exact(1, 0), {{0.1}, {}}, {{}, {}}});
  for (const std::size_t i : {0u, 2u, 3u}) {
    EXPECT_FALSE(places[i].on_front);
    EXPECT_EQ(places[i].confidence, 0);
  }
  EXPECT_TRUE(places[1].on_front);
  EXPECT_EQ(places[1].confidence, 1);
  EXPECT_TRUE(front_of({}).empty());
}

std::vector<FrontCandidate> many(int count, int frames, int pairs) {
  std::vector<FrontCandidate> candidates;
  for (int i = 0; i < count; ++i) {
    FrontCandidate candidate;
    const double quality = std::exp(0.02 * i);
    for (int f = 0; f < frames; ++f) {
      candidate.frame_errors.push_back(quality * (1.2 + std::sin(f)) * (1.1 + 0.1 * std::sin(i * f)));
    }
    for (int k = 0; k < pairs; ++k) candidate.log_ratios.push_back(-0.02 * i + 0.05 * std::sin(i + k * k));
    candidates.push_back(candidate);
  }
  return candidates;
}

TEST(ParetoFrontTest, TheSameSeedGivesTheSameConfidences) {
  const std::vector<FrontCandidate> candidates = many(20, 30, 8);
  const auto once = pareto_front(candidates, 200, 3), again = pareto_front(candidates, 200, 3);
  const auto other = pareto_front(candidates, 200, 4);
  bool differs = false;
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].confidence, again[i].confidence);
    EXPECT_EQ(once[i].on_front, other[i].on_front);
    differs |= once[i].confidence != other[i].confidence;
  }
  EXPECT_TRUE(differs);
}

TEST(ParetoFrontTest, AThousandDrawsOf150CandidatesTakeLessThanASecond) {
  // 5 million draws and additions at 20 ns each are 0.1 s; ten times that leaves room for a busy machine.
  const std::vector<FrontCandidate> candidates = many(150, 60, 20);
  const auto start = std::chrono::steady_clock::now();
  const auto places = front_of(candidates);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::cout << time.count() << " s\n";
  EXPECT_EQ(places.size(), 150u);
  EXPECT_LT(time.count(), 1);
}

TEST(ParetoFrontTest, RefusesWhatCannotBeCompared) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(front_of({{{1, 2}, {0}}, {{1}, {0}}}), std::invalid_argument);
  EXPECT_THROW(front_of({exact(infinity, 0)}), std::invalid_argument);
  EXPECT_THROW(front_of({exact(1, std::nan(""))}), std::invalid_argument);
  EXPECT_THROW(pareto_front({}, 0, kSeed), std::invalid_argument);
}

}  // namespace
}  // namespace herr
