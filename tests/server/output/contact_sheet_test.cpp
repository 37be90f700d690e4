#include "server/output/contact_sheet.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/server/output/pictures.h"

namespace herr {
namespace {

ViewportImage constant_picture(const Viewport& viewport, float value, float alpha) {
  ViewportImage image;
  image.width_px = viewport.width_px;
  image.height_px = viewport.height_px;
  image.row_stride = static_cast<std::size_t>(viewport.width_px);
  image.rgba_half.resize(4 * image.row_stride * static_cast<std::size_t>(viewport.height_px));
  for (std::size_t i = 0; i < image.rgba_half.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) image.rgba_half[i + c] = half_from_float(value);
    image.rgba_half[i + 3] = half_from_float(alpha);
  }
  return image;
}

std::uint8_t pixel(const Srgb8Image& sheet, int x, int y) {
  return sheet.values[3 * static_cast<std::size_t>(y * sheet.width_px + x)];
}

TEST(ContactSheet, ContextViewportsLieAboveFocusViewportsAndTheLeftEyeIsOnTheLeft) {
  const SheetLayout layout = contact_sheet_layout(pictures_of_frame(xr1_profile(), {}));
  ASSERT_EQ(layout.cells.size(), 4u);
  const DisplayProfile profile = xr1_profile();
  for (std::size_t i = 0; i < 4; ++i) {
    const Viewport& viewport = profile.viewports[layout.cells[i].picture];
    EXPECT_EQ(viewport.focus, i >= 2);
    EXPECT_EQ(viewport.eye, i % 2 == 0 ? Eye::left : Eye::right);
  }
  // Two cells and three gaps of 16 px in 1600 px: (1600 - 48) / 2 = 776 wide; heights keep the aspect:
  // 776 for the square ones, 776 * 1350 / 2400 = 436.5, rounded up to 437, for the focus ones.
  EXPECT_EQ(layout.cells[0].width_px, 776);
  EXPECT_EQ(layout.cells[0].height_px, 776);
  EXPECT_EQ(layout.cells[2].height_px, 437);
  EXPECT_EQ(layout.cells[2].y_px, 16 + 776 + 16);
  EXPECT_EQ(layout.width_px, 1600);
  EXPECT_EQ(layout.height_px, 16 + 776 + 16 + 437 + 16);
}

TEST(ContactSheet, SmallViewportsAreNotEnlarged) {
  const SheetLayout layout = contact_sheet_layout(pictures_of_frame(small_profile(), {}));
  EXPECT_EQ(layout.cells[0].width_px, 40);
  EXPECT_EQ(layout.cells[2].width_px, 32);
  EXPECT_EQ(layout.cells[2].height_px, 18);
}

TEST(ContactSheet, FurtherViewsStandInARowBelowTheFocusViewports) {
  RenderSettings settings;
  settings.blended_view = Blend::context;
  const std::vector<PictureOutline> outlines = pictures_of_frame(xr1_profile(), settings);
  const SheetLayout layout = contact_sheet_layout(outlines);
  ASSERT_EQ(layout.cells.size(), 6u);
  EXPECT_EQ(outlines[layout.cells[4].picture].name, "blended-left");
  EXPECT_EQ(outlines[layout.cells[5].picture].name, "blended-right");
  // Behind 16 + 776 + 16 + 437 + 16 rows, as large as the context viewports.
  EXPECT_EQ(layout.cells[4].y_px, 1261);
  EXPECT_EQ(layout.cells[4].width_px, 776);
  EXPECT_EQ(layout.cells[5].x_px, 16 + 776 + 16);
  EXPECT_EQ(layout.height_px, 1261 + 776 + 16);
}

TEST(ContactSheet, AConstantPictureStaysConstantInAnyScale) {
  // 1000 px reduced to 776: the scale is no whole number, so that border pixels take
  // fractions of source pixels.
  const DisplayProfile profile = small_profile(1000, 900, 500);
  std::vector<ViewportImage> pictures;
  for (const Viewport& viewport : profile.viewports)
    pictures.push_back(constant_picture(viewport, 0.5f, 1.0f));
  Srgb8Image sheet;
  draw_contact_sheet(pointers_to(pictures), pictures_of_frame(profile, {}), one_after_another, sheet);
  // 0.5 encodes to 188; its neighbours lie 0.5 % away in linear light, float sums are good to 1e-5.
  for (const SheetCell& cell : contact_sheet_layout(pictures_of_frame(profile, {})).cells) {
    for (int y = 0; y < cell.height_px; ++y) {
      for (int x = 0; x < cell.width_px; ++x) ASSERT_EQ(pixel(sheet, cell.x_px + x, cell.y_px + y), 188);
    }
  }
}

TEST(ContactSheet, WhatIsNotCoveredShowsTheBackground) {
  const DisplayProfile profile = small_profile();
  std::vector<ViewportImage> pictures;
  for (const Viewport& viewport : profile.viewports)
    pictures.push_back(constant_picture(viewport, 0.0f, 0.0f));
  Srgb8Image sheet;
  draw_contact_sheet(pointers_to(pictures), pictures_of_frame(profile, {}), one_after_another, sheet);
  for (const std::uint8_t value : sheet.values) ASSERT_EQ(value, sheet.values.front());
  EXPECT_GT(sheet.values.front(), 0);
}

TEST(ContactSheet, AveragesInLinearLight) {
  // A 1552 px wide viewport of columns black, white, black, ... is halved to 776: every pixel is (0 + 1) / 2
  // = 0.5, which is 188 in sRGB. Averaging encoded values would give 128.
  const DisplayProfile profile = small_profile(1552, 32, 18);
  std::vector<ViewportImage> pictures;
  for (const Viewport& viewport : profile.viewports)
    pictures.push_back(constant_picture(viewport, 0.0f, 1.0f));
  for (int y = 0; y < 1552; ++y) {
    for (int x = 1; x < 1552; x += 2) {
      for (int c = 0; c < 3; ++c) pictures[0].row(y)[4 * x + c] = half_from_float(1.0f);
    }
  }
  Srgb8Image sheet;
  draw_contact_sheet(pointers_to(pictures), pictures_of_frame(profile, {}), one_after_another, sheet);
  EXPECT_EQ(pixel(sheet, 16 + 100, 16 + 100), 188);
}

}  // namespace
}  // namespace herr
