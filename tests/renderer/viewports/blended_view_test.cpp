// What an eye sees of a context and a focus viewport: weights, filters, borders, on every instruction set.
#include "renderer/viewports/blended_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <random>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/viewports/viewport_jobs.h"

namespace herr {
namespace {

using test::Pixel;
using Shade = std::function<Pixel(int x, int y)>;

Viewport focus_of(Viewport viewport, double edge_blend_deg) {
  viewport.focus = true;
  viewport.edge_blend_deg = edge_blend_deg;
  return viewport;
}

// 48 x 48 over +-45 degrees.
Viewport context() {
  return test::viewport_deg(Eye::left, 48, 48, -45, 45, -45, 45);
}

ViewportImage shaded(const Viewport& viewport, const Shade& shade) {
  ViewportImage image;
  image.resize(viewport.width_px, viewport.height_px);
  for (int y = 0; y < viewport.height_px; ++y) {
    for (int x = 0; x < viewport.width_px; ++x) {
      const Pixel pixel = shade(x, y);
      for (int c = 0; c < 4; ++c) {
        image.row(y)[4 * x + c] = test::to_half(pixel[static_cast<std::size_t>(c)]);
      }
    }
  }
  return image;
}

Shade even(double value) {
  return [value](int, int) { return Pixel{value, value, value, value}; };
}

Shade noise(unsigned seed) {
  auto engine = std::make_shared<std::mt19937>(seed);
  return [engine](int, int) {
    std::uniform_real_distribution<double> value(0, 1);
    return Pixel{value(*engine), value(*engine), value(*engine), value(*engine)};
  };
}

struct Case {
  std::vector<Viewport> viewports;
  std::vector<ViewportImage> pictures;
  void add(const Viewport& viewport, const Shade& shade) {
    viewports.push_back(viewport);
    pictures.push_back(shaded(viewport, shade));
  }
};

ViewportImage blended(const Case& of, Isa isa, Blend density = Blend::context) {
  DisplayProfile profile;
  profile.viewports = of.viewports;
  const std::optional<BlendedView> view = blended_view(profile, Eye::left, density);
  ViewportImage out;
  if (!view) return out;
  out.resize(view->outline.width_px, view->outline.height_px);
  std::size_t widest = 0;
  for (const Viewport& v : of.viewports) widest = std::max(widest, padded_row(v.width_px));
  BlendScratch scratch(out.width_px, widest);
  for (int strip = 0; strip < view->strips(); ++strip) {
    blend_strip_for(isa)({&*view, of.pictures, &out}, strip, scratch);
  }
  return out;
}

// The red of the view's only pixel, whose centre lies at the given angles, of a context of `below` and a
// focus over +-20 x +-10 degrees of `over`, blended over 4 degrees.
double only_pixel(double x_deg, double y_deg, double below, double over, Isa isa) {
  const double x = std::tan(x_deg / kDegreesPerRadian), y = std::tan(y_deg / kDegreesPerRadian), r = 1e-3;
  Viewport small = context();
  small.width_px = small.height_px = 1;
  small.tan_left = x - r;
  small.tan_right = x + r;
  small.tan_down = y - r;
  small.tan_up = y + r;
  Case both;
  both.add(small, even(below));
  both.add(focus_of(test::viewport_deg(Eye::left, 64, 32, -20, 20, -10, 10), 4), even(over));
  return test::pixel_at(blended(both, isa), 0, 0)[0];
}

// At a share t of the blend inside the border the weight is t^2 (3 - 2 t): 1/4: 5/32, 1/2: 1/2, 3/4: 27/32.
TEST(BlendedView, WeightsFollowTheAngleToTheNearestBorder) {
  struct Place {
    double x_deg, y_deg, weight;
  };
  const std::vector<Place> places{
      {-21, 0, 0},  {-20, 0, 0}, {-19, 0, 5.0 / 32}, {-18, 0, 0.5},     {-17, 0, 27.0 / 32},
      {-16, 0, 1},  {0, 0, 1},   {17, 0, 27.0 / 32}, {0, 9, 5.0 / 32},  {0, -8, 0.5},
      {0, 10.5, 0}, {0, 6, 1},   {-18, 9, 5.0 / 32}, {19, -8, 5.0 / 32}};
  for (const Isa isa : test::offered_isas()) {
    for (const Place& place : places) {
      SCOPED_TRACE(testing::Message() << name_of(isa) << " " << place.x_deg << ", " << place.y_deg);
      // Rounding to half, and angles that rounding moves by 1e-15: a slope of 1.5 / 4 degrees makes it
      // nothing.
      EXPECT_NEAR(only_pixel(place.x_deg, place.y_deg, 0, 1, isa), place.weight, test::half_rounding(1));
      EXPECT_NEAR(only_pixel(place.x_deg, place.y_deg, 3, 1, isa), 3 - 2 * place.weight,
                  test::half_rounding(4));
    }
  }
}

TEST(BlendedView, EqualPicturesGiveThemselvesBitForBit) {
  const Pixel colour{0.3, 0.7, 60000, 0.8};
  const Shade shade = [&](int, int) { return colour; };
  Case both;
  both.add(context(), shade);
  both.add(focus_of(test::viewport_deg(Eye::left, 101, 67, -20, 20, -13, 11), 3), shade);
  for (const Isa isa : test::offered_isas()) {
    for (const Blend density : {Blend::context, Blend::focus}) {
      const ViewportImage view = blended(both, isa, density);
      const std::uint16_t* expected = both.pictures[0].row(0);
      for (int y = 0; y < view.height_px; ++y) {
        for (int x = 0; x < view.width_px; ++x) {
          ASSERT_TRUE(std::equal(expected, expected + 4, view.row(y) + 4 * x)) << x << ", " << y;
        }
      }
    }
  }
}

TEST(BlendedView, WithoutAFocusViewportItIsTheContext) {
  Case alone;
  alone.add(context(), noise(1));
  for (const Isa isa : test::offered_isas()) {
    EXPECT_TRUE(test::same_bits(blended(alone, isa), alone.pictures[0]));
    EXPECT_TRUE(test::same_bits(blended(alone, isa, Blend::focus), alone.pictures[0]));
  }
}

// With v = c + w (f - c), two neighbours differ by at most what the context does, what the focus does, and
// the step of the weight times the difference of the two pictures:
//   v1 - v0 = (1 - w0) (c1 - c0) + w0 (f1 - f0) + (w1 - w0) (f1 - c1).
// Where the first lies outside the focus w0 is 0 and f0 plays no part.
struct Steps {
  double worst_over = 0;      // the largest step above that bound
  double largest_weight = 0;  // step of the weight
};

double weight_of(const Viewport& f, double tan_x, double tan_y) {
  const auto angle = [](double a, double b) { return (std::atan(b) - std::atan(a)) * kDegreesPerRadian; };
  const double nearest = std::min({angle(f.tan_left, tan_x), angle(tan_x, f.tan_right),
                                   angle(f.tan_down, tan_y), angle(tan_y, f.tan_up)});
  const double t = f.edge_blend_deg > 0 ? std::clamp(nearest / f.edge_blend_deg, 0.0, 1.0) : nearest > 0;
  return t * t * (3 - 2 * t);
}

Steps steps_of(const ViewportImage& v, const ViewportImage& c, const ViewportImage& f,
               const Viewport& of_view, const Viewport& focus) {
  Steps steps;
  const auto weight = [&](int x, int y) {
    return weight_of(focus,
                     of_view.tan_left + (x + 0.5) * (of_view.tan_right - of_view.tan_left) / v.width_px,
                     of_view.tan_up - (y + 0.5) * (of_view.tan_up - of_view.tan_down) / v.height_px);
  };
  const auto look = [&](int x0, int y0, int x1, int y1) {
    if (weight(x1, y1) < weight(x0, y0)) {
      std::swap(x0, x1);
      std::swap(y0, y1);
    }
    const double w0 = weight(x0, y0), w1 = weight(x1, y1);
    const Pixel v0 = test::pixel_at(v, x0, y0), v1 = test::pixel_at(v, x1, y1),
                c0 = test::pixel_at(c, x0, y0), c1 = test::pixel_at(c, x1, y1),
                f0 = test::pixel_at(f, x0, y0), f1 = test::pixel_at(f, x1, y1);
    for (std::size_t i = 0; i < 4; ++i) {
      const double bound = (1 - w0) * std::abs(c1[i] - c0[i]) + w0 * std::abs(f1[i] - f0[i]) +
                           (w1 - w0) * std::abs(f1[i] - c1[i]);
      steps.worst_over = std::max(steps.worst_over, std::abs(v1[i] - v0[i]) - bound);
    }
    steps.largest_weight = std::max(steps.largest_weight, w1 - w0);
  };
  for (int y = 0; y < v.height_px; ++y) {
    for (int x = 0; x < v.width_px; ++x) {
      if (x + 1 < v.width_px) look(x, y, x + 1, y);
      if (y + 1 < v.height_px) look(x, y, x, y + 1);
    }
  }
  return steps;
}

TEST(BlendedView, NoStepIsLargerThanTheBlendMakesIt) {
  // Pixels of 192 over +-45 degrees are 0.6 degrees wide in the middle: over 5 degrees a weight steps by at
  // most 1.5 * 0.6 / 5 = 0.18.
  Viewport wide = context();
  wide.width_px = wide.height_px = 192;
  const Viewport focus = focus_of(test::viewport_deg(Eye::left, 320, 180, -20, 20, -11.57, 11.57), 5);
  Viewport bare = focus;
  bare.edge_blend_deg = 0;
  for (const Isa isa : test::offered_isas()) {
    Case both, focus_alone, hard;
    both.add(wide, noise(3));
    both.add(focus, noise(4));
    // What of the focus the view has, without a blend.
    focus_alone.add(wide, even(0));
    focus_alone.viewports.push_back(bare);
    focus_alone.pictures.push_back(both.pictures[1]);
    hard = both;
    hard.viewports[1] = bare;
    const ViewportImage inner = blended(focus_alone, isa);
    const Steps steps = steps_of(blended(both, isa), both.pictures[0], inner, wide, focus);
    // Each of the four pixels of a step is a rounded half of at most 1.
    EXPECT_LE(steps.worst_over, 4 * test::half_rounding(1)) << name_of(isa);
    EXPECT_LT(steps.largest_weight, 0.181);
    EXPECT_GT(steps.largest_weight, 0.15);
    // A hard edge breaks the same bound: pictures that differ by up to 1 meet there.
    EXPECT_GT(steps_of(blended(hard, isa), both.pictures[0], inner, wide, focus).worst_over, 0.5);
  }
}

// The view's pixels are 0.5 wide in tangents, the focus's 0.2: 2.5 of them, [0, 2.5) and [2.5, 5).
TEST(BlendedView, FocusPixelsAreAveragedByArea) {
  Viewport four = context();
  four.width_px = four.height_px = 4;
  Viewport five = focus_of(four, 0);
  five.width_px = 5;
  five.height_px = 1;
  five.tan_left = five.tan_down = -0.5;
  five.tan_right = five.tan_up = 0.5;
  constexpr std::array<double, 5> kValues{1, 2, 4, 8, 16};
  Case both;
  both.add(four, even(0.25));
  both.add(five, [&](int x, int) { return Pixel{kValues[static_cast<std::size_t>(x)], 0, 0, 1}; });
  for (const Isa isa : test::offered_isas()) {
    const ViewportImage view = blended(both, isa);
    for (const int y : {1, 2}) {
      EXPECT_NEAR(test::pixel_at(view, 1, y)[0], (1 + 2 + 0.5 * 4) / 2.5, test::half_rounding(2));
      EXPECT_NEAR(test::pixel_at(view, 2, y)[0], (0.5 * 4 + 8 + 16) / 2.5, test::half_rounding(16));
      EXPECT_EQ(test::pixel_at(view, 0, y)[0], 0.25) << "outside, a hard edge";
    }
    EXPECT_EQ(test::pixel_at(view, 1, 0)[0], 0.25);
  }
}

TEST(BlendedView, AFineCheckerboardBecomesGrey) {
  Viewport wide = context();
  Case both;
  both.add(wide, even(0));
  Viewport focus = focus_of(wide, 0);
  focus.width_px = focus.height_px = 4 * 48;
  both.add(focus, [](int x, int y) { return (x + y) % 2 == 0 ? Pixel{1, 1, 1, 1} : Pixel{}; });
  for (const Isa isa : test::offered_isas()) {
    test::for_each_pixel(blended(both, isa), [](int x, int y, const Pixel& pixel) {
      ASSERT_EQ(pixel, (Pixel{0.5, 0.5, 0.5, 0.5})) << x << ", " << y;
    });
  }
}

// As dense as the focus, which here has twice the pixels: the context's are interpolated. A view pixel's
// centre lies a quarter of a context pixel off the nearest one's: 3/4 of it, 1/4 of the next.
TEST(BlendedView, TheContextIsInterpolatedWhereTheFocusIsDenser) {
  Viewport two = context();
  two.width_px = two.height_px = 2;
  Viewport focus = focus_of(two, 0);
  focus.tan_left = focus.tan_down = 0.5;
  focus.width_px = focus.height_px = 1;  // 0.5 of tangents, the context's are 1
  Case both;
  both.add(two, [](int x, int y) { return Pixel{double(x), double(y), 0, 1}; });
  both.add(focus, even(8));
  for (const Isa isa : test::offered_isas()) {
    const ViewportImage view = blended(both, isa, Blend::focus);
    ASSERT_EQ(view.width_px, 4);
    ASSERT_EQ(view.height_px, 4);
    constexpr std::array<double, 4> kExpected{0, 0.25, 0.75, 1};
    for (int x = 0; x < 4; ++x) {
      EXPECT_EQ(test::pixel_at(view, x, 2)[0], kExpected[static_cast<std::size_t>(x)]);
      EXPECT_EQ(test::pixel_at(view, 0, x)[1], kExpected[static_cast<std::size_t>(x)]);
    }
    EXPECT_EQ(test::pixel_at(view, 3, 0)[0], 8) << "the focus lies at the upper right";
  }
}

TEST(BlendedView, AFocusThatReachesBeyondTheContextIsCutOffThere) {
  Case both;
  both.add(context(), even(0));
  both.add(focus_of(test::viewport_deg(Eye::left, 90, 60, -70, -10, -50, 10), 2), even(1));
  for (const Isa isa : test::offered_isas()) {
    const ViewportImage view = blended(both, isa);
    EXPECT_EQ(test::pixel_at(view, 0, 47)[0], 1) << "25 degrees and 5 inside its own borders";
    EXPECT_EQ(test::pixel_at(view, 47, 47)[0], 0);
  }
  both.viewports[1] = focus_of(test::viewport_deg(Eye::left, 90, 60, 50, 80, -50, 10), 2);
  for (const Isa isa : test::offered_isas()) {
    EXPECT_TRUE(test::same_bits(blended(both, isa), both.pictures[0])) << "wholly outside";
  }
}

// In the middle of +-5 degrees the border is 5 of 45 degrees away: t = 1/9, weight (1/81) (3 - 2/9) = 25/729.
TEST(BlendedView, ABlendWiderThanTheFocusNeverShowsItWhole) {
  Viewport odd = context();
  odd.width_px = odd.height_px = 49;
  Case both;
  both.add(odd, even(0));
  both.add(focus_of(test::viewport_deg(Eye::left, 64, 64, -5, 5, -5, 5), 45), even(1));
  for (const Isa isa : test::offered_isas()) {
    EXPECT_NEAR(test::pixel_at(blended(both, isa), 24, 24)[0], 25.0 / 729, test::half_rounding(25.0 / 729));
  }
}

// The later one lies above: 5 degrees inside +-20 over 10 degrees its weight is 1/2, over a whole focus of 2
// over a context of 100.
TEST(BlendedView, SeveralFocusViewportsLieOverEachOtherInTheirOrder) {
  const double x = std::tan(15 / kDegreesPerRadian);
  Viewport one = context();
  one.width_px = one.height_px = 1;
  one.tan_left = x - 1e-3;
  one.tan_right = x + 1e-3;
  one.tan_down = -1e-3;
  one.tan_up = 1e-3;
  Case all;
  all.add(one, even(100));
  all.add(focus_of(test::viewport_deg(Eye::left, 40, 40, -30, 30, -30, 30), 1), even(2));
  all.add(focus_of(test::viewport_deg(Eye::left, 40, 40, -20, 20, -20, 20), 10), even(4));
  for (const Isa isa : test::offered_isas()) {
    EXPECT_NEAR(test::pixel_at(blended(all, isa), 0, 0)[0], 3, test::half_rounding(3));
  }
}

TEST(BlendedView, AnEyeWithoutAContextSeesItsFocusAlone) {
  Case alone;
  alone.add(focus_of(context(), 10), noise(5));
  for (const Isa isa : test::offered_isas()) {
    EXPECT_TRUE(test::same_bits(blended(alone, isa), alone.pictures[0]));
    Case other = alone;
    other.viewports[0].eye = Eye::right;
    EXPECT_EQ(blended(other, isa).width_px, 0) << "an eye without viewports sees nothing";
  }
}

// +-45 and 45 ... 60 degrees side by side: tangents -1 ... 1.732, 24 pixels per unit, 65.6 pixels.
TEST(BlendedView, ContextViewportsSideBySideAreSeenTogether) {
  Case both;
  both.add(context(), even(1));
  both.add(test::viewport_deg(Eye::left, 12, 48, 45, 60, -45, 45), even(2));
  for (const Isa isa : test::offered_isas()) {
    const ViewportImage view = blended(both, isa);
    ASSERT_EQ(view.width_px, 66);
    ASSERT_EQ(view.height_px, 48);
    EXPECT_EQ(test::pixel_at(view, 0, 20)[0], 1);
    EXPECT_EQ(test::pixel_at(view, 65, 20)[0], 2);
  }
}

// xr1: the focus has 2400 pixels over 2 tan 20 = 0.72794 of tangents, 3297.0 per unit; the context has 2
// units.
TEST(BlendedView, IsAsLargeAsAskedFor) {
  const DisplayProfile xr1 = xr1_profile();
  const PictureOutline left = *blended_outline(xr1, Eye::left, Blend::context);
  EXPECT_EQ(left.name, "blended-left");
  EXPECT_EQ(left.width_px, 1980);
  EXPECT_EQ(left.height_px, 1980);
  EXPECT_NEAR(left.tan_left, -1, 1e-12);
  EXPECT_NEAR(left.tan_up, 1, 1e-12);
  const PictureOutline right = *blended_outline(xr1, Eye::right, Blend::focus);
  EXPECT_EQ(right.name, "blended-right");
  EXPECT_EQ(right.width_px, 6594);
  EXPECT_FALSE(blended_outline(xr1, Eye::left, Blend::off));
  // A pin-hole of a focus viewport would ask for millions of pixels.
  DisplayProfile dense = xr1;
  dense.viewports[1] = focus_of(test::viewport_deg(Eye::left, 1000, 1000, -0.01, 0.01, -0.01, 0.01), 0);
  EXPECT_EQ(blended_outline(dense, Eye::left, Blend::focus)->width_px, kMostBlendedSide_px);
}

}  // namespace
}  // namespace herr
