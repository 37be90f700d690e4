// Fits and remarks of sweeps by hand.
#include "server/study/findings/study_fits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/server/study/report/study_records.h"

namespace herr {
namespace {

using ErrorOfN = std::function<double(double n)>;

Knob samples(int expected = 1, double fit_from = 0) {
  return {"samples", "samples", "samples per light", "-0.5: independent", expected, fit_from};
}

std::vector<StudyPoint> sweep(const ErrorOfN& error, const std::string& base = "N = 1",
                              std::initializer_list<double> efforts = {64, 1, 4, 256, 16}) {
  std::vector<StudyPoint> points;
  for (const double n : efforts) {
    points.push_back(test::study_point("samples", base, std::to_string(int(n)), n, error(n), 1));
  }
  return points;
}

StudyReference reference(const std::string& name, double acuity_rmse) {
  StudyReference made;
  made.name = name;
  made.error = test::error_table(acuity_rmse);
  return made;
}

const std::vector<StudyReference> kReferences{reference("endless effort", 1e-6)};

StudyFits fits_of(const Knob& knob, const std::vector<StudyPoint>& points,
                  std::span<const StudyReference> references = kReferences) {
  return fit_knobs(std::vector<Knob>{knob}, points, references);
}

TEST(StudyFits, APowerLawIsFound) {
  const StudyFits fits = fits_of(samples(), sweep([](double n) { return 0.2 * std::pow(n, -0.5); }));
  EXPECT_TRUE(fits.remarks.empty());
  ASSERT_EQ(fits.fits.size(), 1u);
  const StudyFit& fit = fits.fits[0];
  EXPECT_EQ(fit.knob, "samples");
  EXPECT_EQ(fit.base, "N = 1");
  EXPECT_EQ(fit.effort, "samples per light");
  EXPECT_EQ(fit.theory, "-0.5: independent");
  EXPECT_EQ(fit.against, "endless effort");
  EXPECT_EQ(fit.remark, "");
  ASSERT_TRUE(fit.fit);
  // The law holds to rounding; a minimum of squares is found to the root of that, 1e-8, times a few.
  EXPECT_NEAR(fit.fit->p.estimate, -0.5, 1e-6);
  EXPECT_NEAR(fit.fit->c, 0.2, 1e-6);
  EXPECT_NEAR(fit.fit->floor.estimate, 0, 1e-6);
  EXPECT_EQ(fit.fit->points, 5);
}

TEST(StudyFits, AFloorIsFoundFromFourPointsOn) {
  const auto error = [](double n) { return 0.05 + 0.2 / n; };
  const StudyFits with = fits_of(samples(), sweep(error, "N = 1", {1, 4, 16, 64}));
  ASSERT_TRUE(with.fits.at(0).fit);
  EXPECT_NEAR(with.fits[0].fit->p.estimate, -1, 1e-5);
  EXPECT_NEAR(with.fits[0].fit->floor.estimate, 0.05, 1e-6);
  const StudyFits without = fits_of(samples(), sweep(error, "N = 1", {1, 4, 16}));
  ASSERT_TRUE(without.fits.at(0).fit);
  EXPECT_EQ(without.fits[0].fit->floor.estimate, 0);
}

TEST(StudyFits, EachBaseIsFittedForItself) {
  std::vector<StudyPoint> points = sweep([](double n) { return 0.2 / n; });
  const std::vector<StudyPoint> soft = sweep([](double n) { return 0.1 / std::sqrt(n); }, "N = 64");
  points.insert(points.end(), soft.begin(), soft.end());
  const StudyFits fits = fits_of(samples(), points);
  ASSERT_EQ(fits.fits.size(), 2u);
  EXPECT_EQ(fits.fits[0].base, "N = 1");
  EXPECT_NEAR(fits.fits[0].fit->p.estimate, -1, 1e-6);
  EXPECT_EQ(fits.fits[1].base, "N = 64");
  EXPECT_NEAR(fits.fits[1].fit->p.estimate, -0.5, 1e-6);
}

// n = 1 is hard light, which is no part of the law; what lies below 3 times the reference's own error is its
// noise, and so is what has not been measured.
TEST(StudyFits, WhatIsNoPartOfTheLawIsLeftOut) {
  std::vector<StudyPoint> points = sweep([](double n) {
    return n < 2 ? 5.0 : n > 100 ? 0.0029 : 0.2 * std::pow(n, -0.5);
  });
  points.push_back(test::study_point("samples", "N = 1", "9", 9, 77, 1));
  points.back().frames = 0;
  points.push_back(test::study_point("other", "N = 1", "9", 9, 77, 1));
  const std::vector<StudyReference> rough{reference("endless effort", 0.001)};
  const StudyFits fits = fits_of(samples(1, 2), points, rough);
  ASSERT_EQ(fits.fits.size(), 1u);
  ASSERT_TRUE(fits.fits[0].fit);
  EXPECT_EQ(fits.fits[0].fit->points, 3);
  EXPECT_NEAR(fits.fits[0].fit->p.estimate, -0.5, 1e-6);
}

TEST(StudyFits, ErrorsAgainstTheKnobsOwnReferenceAreTakenWhereThereAreSome) {
  std::vector<StudyPoint> points = sweep([](double) { return 0.4; });
  for (StudyPoint& point : points) {
    point.own_error = test::error_table(0.3 / point.n);
    point.own_reference = "hard light";
  }
  const std::vector<StudyReference> references{reference("endless effort", 0.1),
                                               reference("hard light", 1e-6)};
  const StudyFits fits = fits_of(samples(), points, references);
  EXPECT_TRUE(fits.remarks.empty());
  EXPECT_EQ(fits.fits.at(0).against, "own reference");
  EXPECT_NEAR(fits.fits[0].fit->p.estimate, -1, 1e-6);
}

TEST(StudyFits, WhatIsOddIsRemarkedUpon) {
  const auto remark_of = [](const Knob& knob, const ErrorOfN& error, double own_error = 1e-6) {
    const std::vector<StudyReference> references{reference("endless effort", own_error)};
    const StudyFits fits = fits_of(knob, sweep(error), references);
    EXPECT_EQ(fits.fits.at(0).remark.empty(), fits.remarks.empty());
    return fits.remarks.empty() ? "" : fits.remarks[0].text;
  };
  const auto rises = [](double n) { return 0.01 * std::sqrt(n); };
  const auto falls = [](double n) { return 0.2 / std::sqrt(n); };
  EXPECT_EQ(remark_of(samples(), rises),
            "N = 1: the error rises with samples per light, from 0.0100 at 1 to 0.1600 at 256, against "
            "expectation");
  EXPECT_EQ(remark_of(samples(-1), falls),
            "N = 1: the error falls with samples per light, from 0.2000 at 1 to 0.0125 at 256, against "
            "expectation");
  EXPECT_EQ(remark_of(samples(-1), rises), "");
  // One step up of a tenth at 64 on the way down.
  const auto stumbles = [&](double n) { return n == 64 ? 1.1 * falls(16) : falls(n); };
  EXPECT_NE(remark_of(samples(), stumbles).find("the error rises with samples per light, from"),
            std::string::npos);
  EXPECT_EQ(remark_of(samples(0), rises), "");
  // 0.1 to 0.1019: 1.9 %.
  EXPECT_EQ(remark_of(samples(), [](double n) { return n < 2 ? 0.1019 : 0.1; }),
            "N = 1: the error changes by less than 2 %: other errors of the default are larger than what it "
            "changes");
  EXPECT_EQ(remark_of(samples(), [](double n) { return n < 2 ? 0.103 : 0.1; }), "");
  EXPECT_EQ(
      remark_of(samples(), falls, 0.07),
      "N = 1: no value can be told from the reference, 3 times whose own error is 0.2100: what it changes "
      "is too little to see here");
  EXPECT_EQ(remark_of(samples(), [](double) { return 0.0; }), "N = 1: it changes nothing in these frames");
}

// The word has the least error; among the sizes the error rises.
TEST(StudyFits, ARemarkTellsValuesAsTheyAreWrittenAndLeavesWordsOut) {
  std::vector<StudyPoint> points;
  points.push_back(test::study_point("samples", "N = 1", "acuity", 0, 0.03, 1));
  points.push_back(test::study_point("samples", "N = 1", "196x192", 194.4839324982915, 0.04, 1));
  points.push_back(test::study_point("samples", "N = 1", "394x384", 388.9678649965831, 0.05, 1));
  const StudyFits fits = fits_of(samples(), points);
  ASSERT_EQ(fits.remarks.size(), 1u);
  EXPECT_EQ(
      fits.remarks[0].text,
      "N = 1: the error rises with samples per light, from 0.0400 at 196x192 to 0.0500 at 394x384, against "
      "expectation");
  points.erase(points.begin() + 1);
  EXPECT_TRUE(fits_of(samples(), points).remarks.empty()) << "one size has no direction";
}

TEST(StudyFits, TooFewPointsAndWordsHaveNoFit) {
  const StudyFits few = fits_of(samples(), sweep([](double n) { return 1 / n; }, "N = 1", {1, 4}));
  ASSERT_EQ(few.fits.size(), 1u);
  EXPECT_FALSE(few.fits[0].fit);
  EXPECT_EQ(few.fits[0].remark, "too few points for a fit");
  Knob words = samples();
  words.effort.clear();
  EXPECT_TRUE(fits_of(words, sweep([](double n) { return 1 / n; })).fits.empty());
  EXPECT_TRUE(fits_of(samples(), {}).fits.empty());
}

}  // namespace
}  // namespace herr
