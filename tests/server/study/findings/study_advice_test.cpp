// Advice and aims of points by hand.
#include "server/study/findings/study_advice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "tests/server/study/report/study_records.h"

namespace herr {
namespace {

StudyPoint point(const std::string& name, const std::string& knob, const std::string& base,
                 const std::string& value, double error, double ratio) {
  StudyPoint made = test::study_point(knob, base, value, 1, error, ratio);
  made.name = name;
  made.flags = name.starts_with("default") ? "" : "--" + name;
  made.comparable = true;
  made.work_ratio = test::around(ratio / 2, 0.03);
  return made;
}

// Errors 0.08 (hard) and 0.02 (soft) of the default.
std::vector<StudyPoint> some_points() {
  return {point("default, N = 1", "default", "N = 1", "", 0.08, 1),
          point("default, N = 64", "default", "N = 64", "", 0.02, 4),
          point("fast", "polar", "N = 1", "", 0.1, 0.5), point("best", "polar", "N = 64", "", 0.004, 9),
          point("middle", "polar", "N = 64", "", 0.019, 3)};
}

const StudyAim& aim_named(const std::vector<StudyAim>& aims, const std::string& name) {
  for (const StudyAim& aim : aims) {
    if (aim.name == name) return aim;
  }
  throw std::runtime_error("no aim " + name);
}

TEST(StudyAdvice, IsTheFastestPointThatIsNoWorse) {
  std::vector<StudyPoint> points = some_points();
  points.push_back(point("of other light", "probe_rays", "N = 1", "", 0.001, 0.1));
  points.back().comparable = false;
  points.push_back(point("not measured", "polar", "N = 1", "", 0.001, 0.1));
  points.back().frames = 0;
  const std::vector<StudyAdvice> advice = advice_of(points, {});
  // 0.08, 0.16, 0.04, 0.02 of hard light, then 0.02, 0.04, 0.01, 0.005 of soft light.
  const std::vector<std::string> expected{"default, N = 1", "fast",   "middle", "middle",
                                          "middle",         "middle", "best",   "best"};
  ASSERT_EQ(advice.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(advice[i].point, expected[i]) << i;
  EXPECT_EQ(
      advice[1].sentence,
      "For an error of at most 0.1600 (twice that of the default with N = 1): take --fast; error 0.1000, "
      "time of the default times 0.50 [0.48, 0.52].");
  EXPECT_NE(advice[0].sentence.find(": take the default; error 0.0800"), std::string::npos);
}

TEST(StudyAdvice, TellsThatNothingIsGoodEnough) {
  std::vector<StudyPoint> points = some_points();
  points.resize(2);
  const std::vector<StudyAdvice> advice = advice_of(points, {});
  EXPECT_EQ(advice.back().point, "");
  EXPECT_EQ(
      advice.back().sentence,
      "For an error of at most 0.00500 (a quarter of that of the default with N = 64): nothing that was "
      "measured reaches it.");
  EXPECT_TRUE(advice_of({}, {}).empty());
}

// The default errs by 0.0347, the reference by 0.0086. 0.0336 is 0.0011 less, 0.0420 is 0.0073 more: neither
// is told apart from the default; 0.0090 is 0.0257 less and is. Default with soft light: 0.0100, from which
// 0.0090 is 0.0010 off. The default itself is not held against itself.
TEST(StudyAdvice, SaysWhereTheReferenceErrsByMoreThanPointAndDefaultDiffer) {
  const StudyReference reference{"endless effort", "", 2, 2, test::error_table(0.0086), false, 1};
  std::vector<StudyPoint> points{point("default, N = 1", "default", "N = 1", "", 0.0347, 1),
                                 point("same", "polar", "N = 1", "", 0.0336, 0.82),
                                 point("worse", "polar", "N = 1", "", 0.0420, 0.5),
                                 point("better", "polar", "N = 64", "", 0.0090, 4)};
  const auto told = [&](double most_error) {
    for (const StudyAdvice& advice : advice_of(points, std::span(&reference, 1))) {
      if (std::abs(advice.most_error - most_error) < 1e-9) return advice.sentence;
    }
    return std::string();
  };
  const std::string doubt = " (as good as the default with N = 1 within the reference's error of 0.00860), ";
  EXPECT_EQ(told(0.0347),
            "For an error of at most 0.0347 (that of the default with N = 1): take --same; error 0.0336" +
                doubt + "time of the default times 0.82 [0.80, 0.84].");
  EXPECT_NE(told(0.0694).find("take --worse; error 0.0420" + doubt), std::string::npos) << told(0.0694);
  EXPECT_NE(told(0.01735).find("take --better; error 0.00900, time"), std::string::npos) << told(0.01735);
  for (const StudyAdvice& advice : advice_of(points, {})) {
    EXPECT_EQ(advice.sentence.find("as good as"), std::string::npos) << advice.sentence;  // none that errs
  }
  points.push_back(point("default, N = 64", "default", "N = 64", "", 0.01, 6));
  points.back().flags = "--light-samples 64";
  EXPECT_NE(told(0.01).find("(as good as the default with N = 64 within"), std::string::npos) << told(0.01);
  points.resize(1);
  EXPECT_NE(told(0.0347).find("take the default; error 0.0347, time"), std::string::npos) << told(0.0347);
}

TEST(StudyAdvice, SaysAtWhichScaleItWasFound) {
  EXPECT_EQ(advice_note(0.4),
            "Found at profile scale 0.4, which sees less of the fine detail; confirm at full scale.");
  EXPECT_EQ(advice_note(1), "");
}

// Errors times times: 0.05, 0.03, 0.04, 0.08. From `b` half of the error (`d`) takes 4 times its time, and a
// third of its time (`a`) has 5 times its error. What is off the front, however small its product, is no
// knee.
TEST(StudyAdvice, TheKneeHasTheLeastProductOfErrorAndTimeOnTheFront) {
  std::vector<StudyPoint> points{
      point("a", "polar", "N = 1", "", 0.1, 0.5), point("b", "polar", "N = 1", "", 0.02, 1.5),
      point("c", "polar", "N = 64", "", 0.016, 2.5), point("d", "polar", "N = 64", "", 0.01, 8)};
  for (StudyPoint& one : points) one.on_front = true;
  points.push_back(point("off", "polar", "N = 1", "", 0.001, 0.1));
  const std::vector<StudyAdvice> advice = advice_of(points, {});
  ASSERT_EQ(advice.size(), 1u);  // no default, nothing else to say
  EXPECT_EQ(advice[0].point, "b");
  EXPECT_EQ(advice[0].most_error, 0.02);
  EXPECT_EQ(
      advice[0].sentence,
      "At the knee of the front: take --b; error 0.0200, time of the default times 1.50 [1.46, 1.54]. "
      "Nothing that was measured has half its error in less than twice its time, or takes half its time "
      "with less than twice its error.");
  // 0.05, 0.04: of two points one is no knee.
  points[1].on_front = points[3].on_front = false;
  EXPECT_TRUE(advice_of(points, {}).empty());
}

// Products of a, b, c: 0.1, 0.095, 0.04, the least where the error is; then 0.1, 0.4, 1, the least where the
// time is; then 0.1, 0.05, 0.4, the least between both. The default (product 0.2) is not on the front; at
// most its error, 0.1, has `a`.
TEST(StudyAdvice, AnEndOfWhatWasMeasuredIsNoKneeAndComesLast) {
  std::vector<StudyPoint> points{
      point("a", "polar", "N = 1", "", 0.1, 1), point("b", "polar", "N = 1", "", 0.05, 1.9),
      point("c", "polar", "N = 1", "", 0.01, 4), point("default, N = 1", "default", "N = 1", "", 0.1, 2)};
  for (std::size_t i = 0; i < 3; ++i) points[i].on_front = true;
  const auto expect = [&](const std::string& least, const std::string& remark) {
    const std::vector<StudyAdvice> advice = advice_of(points, {});
    ASSERT_EQ(advice.size(), 5u);
    EXPECT_EQ(advice.front().sentence,
              "For an error of at most 0.1000 (that of the default with N = 1): take --a; error 0.1000, time "
              "of the default times 1.00 [0.97, 1.03].");
    EXPECT_EQ(advice.back().point, least);
    EXPECT_EQ(
        advice.back().sentence.rfind(
            "For the least product of error and time, at an end of what was measured: take --" + least, 0),
        0u)
        << advice.back().sentence;
    EXPECT_NE(advice.back().sentence.find(remark), std::string::npos) << advice.back().sentence;
    for (const StudyAdvice& line : advice)
      EXPECT_EQ(line.sentence.find("knee"), std::string::npos) << line.sentence;
  };
  expect("c", " It has the least error: more effort may pay.");
  points[1].time_ratio.estimate = 8, points[2].time_ratio.estimate = 100;
  expect("a", " It is the quickest: quicker ones may pay, too.");
  points[1].error = test::error_table(0.04), points[1].time_ratio.estimate = 1.25;
  points[2].time_ratio.estimate = 40;
  const std::vector<StudyAdvice> advice = advice_of(points, {});
  ASSERT_EQ(advice.size(), 5u);
  EXPECT_EQ(advice.front().sentence.rfind("At the knee of the front: take --b;", 0), 0u);
  EXPECT_EQ(advice[1].most_error, 0.1);
}

// With soft light the number of their samples is free: what foveation buys is not to be flattered.
TEST(StudyAims, RaysPerPixelHaveTheirLightSamplesFree) {
  std::vector<StudyPoint> points = some_points();
  points.push_back(point("scale 1", "uniform", "N = 64", "1", 0.003, 36));
  points.push_back(point("scale 0.5", "uniform", "N = 64", "0.5", 0.018, 10));
  points.push_back(point("scale 0.25", "uniform", "N = 64", "0.25", 0.05, 3));
  points.push_back(point("scale 0.5, fewer", "uniform", "N = 16", "0.5", 0.0185, 6));
  const std::vector<StudyAim> aims = aims_of(points);
  ASSERT_EQ(aims.size(), 2u);  // hard light has no full scale here
  // 36 / 4 = 9, at least 8.
  const StudyAim& full = aim_named(aims, "rays per pixel at full scale, N = 64: time against ours");
  EXPECT_NEAR(full.measured.estimate, 9, 1e-12);
  EXPECT_EQ(full.aim, 8);
  EXPECT_TRUE(full.met && full.at_least);
  // At an error of 0.02 scale 0.5 with fewer samples is the fastest: 6 / 4.
  const StudyAim& same =
      aim_named(aims, "rays per pixel at the error of foveation, N = 64: time against ours");
  EXPECT_NEAR(same.measured.estimate, 1.5, 1e-12);
  EXPECT_TRUE(same.met);
  EXPECT_NE(same.sentence.find("Scale 0.5 with N = 16 has error 0.0185, default, N = 64 has 0.0200"),
            std::string::npos);
  points[points.size() - 4].time_ratio = test::around(28, 0.03);  // 7 times
  EXPECT_FALSE(aims_of(points)[0].met);
  // No scale is as good: the best one is named.
  for (StudyPoint& one : points) {
    if (one.knob == "uniform") one.error = test::error_table(one.value == "1" ? 0.03 : 0.3);
  }
  EXPECT_NE(aims_of(points)[1].sentence.find("the least, at scale 1, is 0.0300"), std::string::npos);
}

TEST(StudyAims, OtherNumbersOfSamplesAreHeldAgainstTheSweepOfThose) {
  std::vector<StudyPoint> points = some_points();
  points.push_back(point("scale 1", "uniform", "N = 16", "1", 0.01, 12));
  points.push_back(point("light samples 16", "light_samples", "", "16", 0.03, 2));
  points.back().own_error = test::error_table(0.001);  // the noise of the samples alone
  const std::vector<StudyAim> aims = aims_of(points);
  ASSERT_EQ(aims.size(), 2u);
  EXPECT_NEAR(aims[0].measured.estimate, 6, 1e-12);
  EXPECT_EQ(aims[0].aim, 1);
  // 0.01 is no more than the 0.03 of 16 samples against endless effort, though more than their noise.
  EXPECT_NEAR(aims[1].measured.estimate, 6, 1e-12);
}

TEST(StudyAims, ThePapersSettingsAreHeldAgainstWhatIsNoWorseInTimeThatIsNotPixels) {
  std::vector<StudyPoint> points = some_points();
  points.push_back(point("paper, soft", "paper", "N = 64", "2048x1024", 0.02, 5));
  points.push_back(point("paper, hard", "paper", "N = 1", "2048x1024", 0.09, 1));
  points.back().own_error = test::error_table(0.01);
  points.back().own_reference = "hard light";
  points.push_back(point("ours, hard", "filter", "N = 1", "bicubic", 0.2, 0.8));
  points.back().own_error = test::error_table(0.009);
  points.back().own_reference = "hard light";
  const std::vector<StudyAim> aims = aims_of(points);
  ASSERT_EQ(aims.size(), 2u);
  // Soft: "middle", 3 / 5 = 0.6, at most 0.7. Hard: against hard light alone, 0.8 / 1.
  EXPECT_NEAR(aims[0].measured.estimate, 0.6, 1e-12);
  EXPECT_TRUE(aims[0].met && !aims[0].at_least);
  EXPECT_EQ(aims[0].sentence.rfind("middle (--middle): error 0.0190 against 0.0200; time 0.60", 0), 0u)
      << aims[0].sentence;
  EXPECT_NEAR(aims[1].measured.estimate, 0.8, 1e-12);
  EXPECT_FALSE(aims[1].met);
  EXPECT_NE(aims[1].sentence.find("both against hard light"), std::string::npos);
}

}  // namespace
}  // namespace herr
