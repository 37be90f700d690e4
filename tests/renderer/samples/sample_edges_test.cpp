// Frame 60 of `desk-walk` against the mean over sixteen places of every polar cell, with and without further
// rays through edges, by distance from the gaze.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/frame/renderer_impl.h"
#include "scenes/load_scene.h"
#include "sessions/session.h"
#include "tests/missing_tool.h"
#include "tests/paths.h"
#include "tests/renderer/half_pixels.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr std::array<double, 5> kBandEdgesDeg{0, 2, 5, 15, 30};
using Bands = std::array<double, kBandEdgesDeg.size() - 1>;
using Picture = std::vector<std::array<double, 3>>;

std::filesystem::path root() {
  return test::source_dir();
}

// The left eye's viewports, one after the other.
Picture picture_of(const RenderedFrame& frame) {
  Picture out;
  for (const ViewportImage& image : frame.viewports) {
    test::for_each_pixel(image, [&](int, int, const test::Pixel& p) { out.push_back({p[0], p[1], p[2]}); });
  }
  return out;
}

void limit_to_white(Picture& picture) {
  for (auto& pixel : picture) {
    for (double& value : pixel) value = std::min(value, 1.0);
  }
}

class SampleEdgesTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path samples = root() / "scenes" / "samples";
    if (!std::filesystem::exists(samples / "generated" / "teapot.glb")) {
      HERR_MISSING_TOOL("scenes/samples/generated is missing; an ordinary build makes it");
    }
    scene_ = load_scene(samples / "general.scene.json");
    session_.emplace(Session::open(root() / "sessions" / "samples" / "desk-walk"));
    sample_ = session_->sample(session_->start_ns() + 1'000'000'000);
    scene_state_at(scene_, 1.0, state_);
    for (const Viewport& viewport : xr1_half_profile().viewports) {
      if (viewport.eye == Eye::left) profile_.viewports.push_back(viewport);
    }
  }

  // A renderer whose probes have seen a few frames: the same ones for any setting.
  std::unique_ptr<Renderer> renderer_with(int edge_samples) const {
    RenderSettings settings;
    settings.edge_samples = edge_samples;
    auto renderer = std::make_unique<Renderer>(scene_, profile_, settings, true);
    for (int i = 0; i < 4; ++i) renderer->skip_frame(sample_, state_);
    return renderer;
  }
  Picture pass(Renderer& renderer, const FrameSample& sample, const CellPlace& place) const {
    PixelPass pass;
    pass.cell = place;
    RenderedFrame frame;
    renderer.render_pass(sample, state_, pass, frame);
    edge_share_ =
        static_cast<double>(frame.counters.edge_samples) / static_cast<double>(frame.counters.polar_samples);
    return picture_of(frame);
  }
  // The mean over sixteen places of every cell.
  Picture reference_of(Renderer& plain, const FrameSample& sample) const {
    Picture reference;
    constexpr int kSide = 4;
    for (int i = 0; i < kSide * kSide; ++i) {
      const Picture one =
          pass(plain, sample, {(i % kSide + 0.5) / kSide - 0.5, (i / kSide + 0.5) / kSide - 0.5});
      if (reference.empty()) reference.resize(one.size());
      for (std::size_t p = 0; p < one.size(); ++p) {
        for (std::size_t c = 0; c < 3; ++c) reference[p][c] += one[p][c] / (kSide * kSide);
      }
    }
    limit_to_white(reference);
    return reference;
  }
  Picture shown_by(Renderer& renderer, const FrameSample& sample) const {
    Picture picture = pass(renderer, sample, {});
    limit_to_white(picture);
    return picture;
  }
  Bands rmse(const Picture& picture, const Picture& reference, const glm::dvec3& gaze) const {
    Bands squares{}, counts{};
    std::size_t at = 0;
    for (const Viewport& view : profile_.viewports) {
      for (int y = 0; y < view.height_px; ++y) {
        for (int x = 0; x < view.width_px; ++x, ++at) {
          const double deg = eccentricity_deg(gaze, test::direction_of_pixel(view, x, y));
          for (std::size_t band = 0; band < squares.size(); ++band) {
            if (deg < kBandEdgesDeg[band] || deg >= kBandEdgesDeg[band + 1]) continue;
            for (std::size_t c = 0; c < 3; ++c) {
              squares[band] += (picture[at][c] - reference[at][c]) * (picture[at][c] - reference[at][c]);
            }
            counts[band] += 3;
          }
        }
      }
    }
    for (std::size_t band = 0; band < squares.size(); ++band)
      squares[band] = std::sqrt(squares[band] / counts[band]);
    return squares;
  }

  Scene scene_;
  SceneState state_;
  std::optional<Session> session_;
  FrameSample sample_;
  DisplayProfile profile_;
  mutable double edge_share_ = 0;
};

Picture difference(const Picture& a, const Picture& b) {
  Picture out(a.size());
  for (std::size_t p = 0; p < a.size(); ++p) {
    for (std::size_t c = 0; c < 3; ++c) out[p][c] = a[p][c] - b[p][c];
  }
  return out;
}

void expect_shares_below(const Bands& before, const Bands& after, double most, const char* what) {
  for (std::size_t band = 0; band < before.size(); ++band) {
    std::cout << what << ", " << kBandEdgesDeg[band] << " to " << kBandEdgesDeg[band + 1]
              << " degrees: " << before[band] << " without, " << after[band]
              << " with four further rays: " << after[band] / before[band] << "\n";
    EXPECT_LT(after[band], most * before[band]);
  }
}

// The goal of edge samples: less than six tenths of the error in a still picture, and of what it changes from
// one frame of a turning head to the next. Measured 0.48 to 0.58, on xr1, too.
TEST_F(SampleEdgesTest, FourFurtherRaysLeaveLessThanSixTenthsOfErrorAndFlicker) {
  const auto plain = renderer_with(0), smooth = renderer_with(4);
  FrameSample turned = sample_;
  turned.head.world_from_head.orientation =
      sample_.head.world_from_head.orientation * glm::angleAxis(glm::radians(0.3), glm::dvec3{0, 1, 0});
  const Picture still = reference_of(*plain, sample_), later = reference_of(*plain, turned);
  const auto errors_of = [&](Renderer& renderer) {
    return std::array{difference(shown_by(renderer, sample_), still),
                      difference(shown_by(renderer, turned), later)};
  };
  const auto before = errors_of(*plain), after = errors_of(*smooth);
  std::cout << 100 * edge_share_ << " % of samples lie at edges\n";
  const glm::dvec3 gaze = plain->internals().eyes[0].gaze.gaze;
  const Picture nothing(still.size());
  expect_shares_below(rmse(before[0], nothing, gaze), rmse(after[0], nothing, gaze), 0.6, "error");
  expect_shares_below(rmse(before[1], before[0], gaze), rmse(after[1], after[0], gaze), 0.6, "flicker");
}

}  // namespace
}  // namespace herr
