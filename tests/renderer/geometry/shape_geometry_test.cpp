// Spheres and boxes against double precision, ray by ray.
#include "renderer/geometry/shape_geometry.h"

#include <gtest/gtest.h>

#include <iostream>

#include "tests/renderer/geometry/shape_rays.h"

namespace herr {
namespace {

constexpr double kU = 0x1p-24;  // one rounding to float; a unit in the last place is up to twice that
constexpr double kFarthest = 1000;

struct Tally {
  int hits = 0, undecided = 0, wrong = 0, far_off = 0, bad_normals = 0;
  double worst = 0;  // error of t over its bound
};

struct Judgement {
  double t;        // exact; 0: no crossing ahead
  bool undecided;  // within rounding of touching, or of starting on the surface
  double bound;    // of the error of t
};

// Sphere. The closest approach is found in two steps, so that rounding along the ray is of second order and
// each coordinate across it is rounded twice: |l|^2 is off by 2 * 2u for that, 3u for its sum and u for 1 -
// |l|^2. Without fused multiply-add the product t d is rounded too, by u |o| a step. t: the square root turns
// an error E of the discriminant D into at most E / sqrt(D), in units of the ray's length; what is known of
// the start, u |o|, is magnified by the slope 1 / sqrt(D) in the same way. Four units in the last place (8u)
// of t and of |o| / sqrt(D) cover both.
Judgement judge_sphere(const test::ShapeRay& ray, bool fused) {
  const test::ExactCrossing exact = test::cross_sphere(ray);
  const double far = std::max(1.0, static_cast<double>(glm::length(glm::dvec3(ray.origin))));
  const double error = 8 * kU + (fused ? 0.0 : 4 * kU * far);
  const double at_start = std::abs(glm::dot(glm::dvec3(ray.origin), glm::dvec3(ray.origin)) - 1);
  Judgement judged{0, std::abs(exact.margin) < error || at_start < 4 * kU, 0};
  if (exact.margin < 0) return judged;
  judged.t = exact.enter > 0 ? exact.enter : std::max(exact.leave, 0.0);
  const double slope = std::sqrt(exact.margin), length = glm::length(glm::dvec3(ray.direction));
  judged.bound = 8 * kU * (judged.t + far / (length * slope));
  return judged;
}

// Box. Each plane costs one rounded subtraction and one rounded division: t is off by 2u of itself, and where
// entry and exit differ by less than twice that, either order is right.
Judgement judge_box(const test::ShapeRay& ray) {
  const test::ExactCrossing exact = test::cross_box(ray);
  Judgement judged{0, std::abs(exact.margin) <= 4.01 * kU, 0};
  if (exact.margin < 0) return judged;
  judged.t = exact.enter > 0 ? exact.enter : std::max(exact.leave, 0.0);
  judged.bound = 2.01 * kU * judged.t;
  return judged;
}

// The normal is the unit sphere's point, or that of a face on which the point lies.
bool normal_fits(ShapeKind kind, const test::ShapeRay& ray, const test::ShapeHit& hit, double slack) {
  const glm::dvec3 p = glm::dvec3(ray.origin) + static_cast<double>(hit.t) * glm::dvec3(ray.direction);
  const glm::dvec3 n(hit.normal);
  if (kind == ShapeKind::sphere) return glm::distance(p, n) <= slack;
  return std::abs(glm::length(n) - 1) == 0 && std::abs(glm::dot(p, n) - 1) <= slack;
}

Tally compare(Isa isa, ShapeKind kind, const std::vector<test::ShapeRay>& rays) {
  const test::TracedShapes traced = test::trace_shape(isa, kind, rays);
  EXPECT_EQ(traced.disagreeing, 0);
  Tally tally;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Judgement judged =
        kind == ShapeKind::sphere ? judge_sphere(rays[i], isa != Isa::sse4) : judge_box(rays[i]);
    const test::ShapeHit& hit = traced.hits[i];
    if (judged.undecided) {
      ++tally.undecided;
      continue;
    }
    tally.wrong += hit.hit != (judged.t > 0);
    if (!hit.hit || !(judged.t > 0)) continue;
    ++tally.hits;
    const double error = std::abs(static_cast<double>(hit.t) - judged.t);
    tally.worst = std::max(tally.worst, error / judged.bound);
    tally.far_off += error > judged.bound;
    // The point moves with t; sums and products of the normal itself are rounded four times.
    const double slack = 2 * judged.bound * glm::length(glm::dvec3(rays[i].direction)) + 16 * kU;
    tally.bad_normals += !normal_fits(kind, rays[i], hit, slack);
  }
  return tally;
}

void expect_exact(Isa isa, ShapeKind kind, bool grazing, int count) {
  const std::uint32_t seed = 20240 + static_cast<std::uint32_t>(kind) * 2 + (grazing ? 1u : 0u);
  test::ShapeRayMaker maker(seed);
  std::vector<test::ShapeRay> rays;
  rays.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    rays.push_back(grazing ? maker.grazing_ray(kind, kFarthest) : maker.random_ray(kFarthest));
  }
  const Tally tally = compare(isa, kind, rays);
  std::cout << name_of(isa) << (kind == ShapeKind::sphere ? " sphere, " : " box, ")
            << (grazing ? "grazing" : "random") << ", seed " << seed << ": " << count << " rays, "
            << tally.hits << " hits, " << tally.undecided
            << " within rounding of touching, largest error of t " << tally.worst << " of its bound\n";
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_EQ(tally.far_off, 0);
  EXPECT_EQ(tally.bad_normals, 0);
  EXPECT_GT(tally.hits, count / 5);
  // Of random rays next to none. Grazing ones pass by 1e-7 ... 1e-2, evenly over the five decades, from 1 ...
  // 1000 radii away. What rounding decides grows with that distance r in the worst case, below about 1.2e-7
  // r: on average (log10(1.2) + 1.5) / 5 = 32 % of them.
  EXPECT_LT(tally.undecided, grazing ? count * 35 / 100 : count / 1000);
}

class ShapeRayTest : public testing::TestWithParam<Isa> {
 protected:
  void SetUp() override {
    if (resolve_isa(Isa::best) < GetParam()) GTEST_SKIP() << "this CPU has no " << name_of(GetParam());
  }
  // A million where it counts: on what this machine runs.
  static int count() { return GetParam() == resolve_isa(Isa::best) ? 1'000'000 : 100'000; }
};

TEST_P(ShapeRayTest, RandomRaysMeetTheSphereAsInDoublePrecision) {
  expect_exact(GetParam(), ShapeKind::sphere, false, count());
}
TEST_P(ShapeRayTest, GrazingRaysMeetTheSphereAsInDoublePrecision) {
  expect_exact(GetParam(), ShapeKind::sphere, true, count());
}
TEST_P(ShapeRayTest, RandomRaysMeetTheBoxAsInDoublePrecision) {
  expect_exact(GetParam(), ShapeKind::box, false, count());
}
TEST_P(ShapeRayTest, GrazingRaysMeetTheBoxAsInDoublePrecision) {
  expect_exact(GetParam(), ShapeKind::box, true, count());
}

struct SpecialRay {
  const char* what;
  ShapeKind kind;
  test::ShapeRay ray;
  float t;  // 0: no hit
  glm::vec3 normal;
};

TEST_P(ShapeRayTest, RaysOnPlanesLimbsAndSurfacesAreNeitherLostNorDoubled) {
  using enum ShapeKind;
  const std::vector<SpecialRay> rays{
      {"through the middle", sphere, {{0, 0, 3}, {0, 0, -2}}, 1, {0, 0, 1}},
      {"from the middle", sphere, {{0, 0, 0}, {0, 4, 0}}, 0.25f, {0, 1, 0}},
      {"tangent", sphere, {{1, 0, 5}, {0, 0, -1}}, 5, {1, 0, 0}},
      {"from the surface outwards", sphere, {{1, 0, 0}, {1, 0, 0}}, 0, {}},
      {"from the surface inwards", sphere, {{1, 0, 0}, {-1, 0, 0}}, 2, {-1, 0, 0}},
      {"away", sphere, {{0, 0, 3}, {0, 0, 1}}, 0, {}},
      {"without a direction", sphere, {{0, 0, 0.5f}, {0, 0, 0}}, 0, {}},
      {"through the middle", box, {{0, 0, 3}, {0, 0, -2}}, 1, {0, 0, 1}},
      {"from within", box, {{0, 0.5f, 0}, {0, 4, 0}}, 0.125f, {0, 1, 0}},
      {"in the plane of a face", box, {{1, 0, 5}, {0, 0, -1}}, 4, {0, 0, 1}},
      {"in the plane of the other face", box, {{-1, 0, 5}, {-0.0f, 0, -1}}, 4, {0, 0, 1}},
      {"along an edge", box, {{1, -1, 5}, {0, 0, -1}}, 4, {0, 0, 1}},
      {"beside, axis-parallel", box, {{1.0000001f, 0, 5}, {0, 0, -1}}, 0, {}},
      {"all but parallel", box, {{0.5f, 0, 5}, {1e-40f, -1e-40f, -1}}, 4, {0, 0, 1}},
      {"from a face outwards", box, {{1, 0, 0}, {1, 0, 0}}, 0, {}},
      {"from a face inwards", box, {{1, 0, 0}, {-1, 0, 0}}, 2, {-1, 0, 0}},
      {"without a direction", box, {{0, 0, 0.5f}, {0, 0, 0}}, 0, {}},
  };
  for (const SpecialRay& special : rays) {
    // Alone and among its likes: single rays and whole packets take different ways.
    for (const std::size_t copies : {1u, 16u}) {
      const auto traced = test::trace_shape(GetParam(), special.kind, {copies, special.ray});
      EXPECT_EQ(traced.disagreeing, 0) << special.what;
      for (const test::ShapeHit& hit : traced.hits) {
        EXPECT_EQ(hit.hit, special.t > 0) << special.what << (special.kind == box ? ", box" : ", sphere");
        if (!hit.hit) continue;
        EXPECT_EQ(hit.t, special.t) << special.what;
        EXPECT_EQ(hit.normal, special.normal) << special.what;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, ShapeRayTest, testing::Values(Isa::sse4, Isa::avx2, Isa::avx512),
                         [](const auto& which) { return std::string(name_of(which.param)); });

}  // namespace
}  // namespace herr
