#include "server/study/relations/gaze/near_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "renderer/renderer.h"

namespace herr {
namespace {

constexpr int kParts = 3;   // of a pixel along each axis: the middle one lies about its middle
constexpr int kPasses = 4;  // rays through each part
// Of parts 0, 1, 2 and 3 away: the integral of 1 - |t| over each.
constexpr std::array<double, kParts + 1> kWeights{11.0 / 36, 8.0 / 36, 4.0 / 36, 0.5 / 36};

double near_limited(float value) {
  return std::clamp(double{value}, 0.0, 1.0);
}

// Of one channel of the pixel (x, y): the weighted squares of what the parts about it differ by.
class NearSquares {
 public:
  NearSquares(const LinearPicture& middles, const LinearPicture& parts, std::size_t channel)
      : middles_(middles), parts_(parts), channel_(channel) {}

  void add(int x, int y) {
    const double middle = near_limited(middles_.plane[channel_][place(middles_, x, y)]);
    for (int row = -kParts; row <= kParts; ++row) {
      for (int column = -kParts; column <= kParts; ++column) {
        const int px = kParts * x + kParts / 2 + column, py = kParts * y + kParts / 2 + row;
        if (px < 0 || py < 0 || px >= parts_.width_px || py >= parts_.height_px) continue;
        const double weight = kWeights[static_cast<std::size_t>(std::abs(row))] *
                              kWeights[static_cast<std::size_t>(std::abs(column))];
        const double apart = near_limited(parts_.plane[channel_][place(parts_, px, py)]) - middle;
        sum_ += weight * apart * apart, weights_ += weight;
      }
    }
  }
  double sum() const { return sum_; }
  double weights() const { return weights_; }

 private:
  static std::size_t place(const LinearPicture& picture, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) +
           static_cast<std::size_t>(x);
  }

  const LinearPicture& middles_;
  const LinearPicture& parts_;
  std::size_t channel_;
  double sum_ = 0, weights_ = 0;
};

}  // namespace

double mean_square_of_near_rays(const RelationCase& by_pixel, const std::vector<LinearPicture>& middles) {
  RelationCase finer = by_pixel;
  for (Viewport& viewport : finer.profile.viewports)
    viewport.width_px *= kParts, viewport.height_px *= kParts;
  Renderer renderer(finer.scene, finer.profile, finer.settings, false);
  RenderedFrame frame;
  LinearPicture parts;
  double sum = 0, weights = 0;
  for (int index = 0; index < kPasses; ++index) {
    PixelPass pass;
    pass.jitter = true;
    pass.index = index;
    renderer.render_pass(finer.sample, finer.state, pass, frame);
    for (std::size_t v = 0; v < middles.size(); ++v) {
      read_viewport(frame.viewports[v], parts);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        NearSquares squares(middles[v], parts, channel);
        for (int y = 0; y < middles[v].height_px; ++y) {
          for (int x = 0; x < middles[v].width_px; ++x) squares.add(x, y);
        }
        sum += squares.sum(), weights += squares.weights();
      }
    }
  }
  return weights > 0 ? sum / weights : 0;
}

}  // namespace herr
