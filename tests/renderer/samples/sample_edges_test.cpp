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
  Picture pass(Renderer& renderer, const CellPlace& place) const {
    PixelPass pass;
    pass.cell = place;
    RenderedFrame frame;
    renderer.render_pass(sample_, state_, pass, frame);
    edge_share_ =
        static_cast<double>(frame.counters.edge_samples) / static_cast<double>(frame.counters.polar_samples);
    return picture_of(frame);
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

// The goal of edge samples, measured 0.46 to 0.55 on xr1.
TEST_F(SampleEdgesTest, FourFurtherRaysLeaveLessThanSixTenthsOfTheError) {
  const auto plain = renderer_with(0);
  Picture reference;
  constexpr int kSide = 4;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Picture one = pass(*plain, {(i % kSide + 0.5) / kSide - 0.5, (i / kSide + 0.5) / kSide - 0.5});
    if (reference.empty()) reference.resize(one.size());
    for (std::size_t p = 0; p < one.size(); ++p) {
      for (std::size_t c = 0; c < 3; ++c) reference[p][c] += one[p][c] / (kSide * kSide);
    }
  }
  limit_to_white(reference);
  const glm::dvec3 gaze = plain->internals().eyes[0].gaze.gaze;
  const auto error_of = [&](Renderer& renderer) {
    Picture picture = pass(renderer, {});
    limit_to_white(picture);
    return rmse(picture, reference, gaze);
  };
  const Bands before = error_of(*plain), after = error_of(*renderer_with(4));
  std::cout << 100 * edge_share_ << " % of samples lie at edges\n";
  for (std::size_t band = 0; band < before.size(); ++band) {
    std::cout << kBandEdgesDeg[band] << " to " << kBandEdgesDeg[band + 1] << " degrees: RMSE " << before[band]
              << " without, " << after[band] << " with four further rays: " << after[band] / before[band]
              << "\n";
    EXPECT_LT(after[band], 0.6 * before[band]);
  }
}

}  // namespace
}  // namespace herr
