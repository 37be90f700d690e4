// The yardstick of `herr check`: always the same work.
#include <gtest/gtest.h>

#include <stdexcept>

#include "renderer/bench/calibration_rays.h"

namespace herr {
namespace {

TEST(CalibrationRays, AllHitTheGroundOnEveryInstructionSet) {
  // Directions lean by at most 0.5 + 0.11 per metre of depth: from 30 m above the middle of 100 m by 100 m of
  // ground no ray of the 64 x 64 can miss.
  for (const Isa isa : {Isa::sse4, Isa::avx2, Isa::avx512}) {
    try {
      resolve_isa(isa);
    } catch (const std::invalid_argument&) {
      continue;  // this CPU lacks it
    }
    const CalibrationRays rays(isa, 1);
    for (int job = 0; job < rays.jobs(); ++job) {
      EXPECT_EQ(rays.trace(job), 64u * 64u) << name_of(isa) << ", job " << job;
    }
  }
}

TEST(CalibrationRays, GiveEveryThreadAsMuchWork) {
  const CalibrationRays one(Isa::sse4, 1), three(Isa::sse4, 3);
  EXPECT_EQ(three.jobs(), 3 * one.jobs());
  EXPECT_EQ(one.trace(one.jobs() - 1), three.trace(three.jobs() - 1));
}

TEST(CalibrationRays, NameTheLibrariesThatRun) {
  const std::string versions = CalibrationRays(Isa::sse4, 1).library_versions();
  EXPECT_EQ(versions.find("Embree "), 0u) << versions;
  EXPECT_NE(versions.find("oneTBB 20"), std::string::npos) << versions;
}

}  // namespace
}  // namespace herr
