#include "server/frames/auto_exposure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/model/scene.h"
#include "server/frames/opened_session.h"
#include "server/output/srgb_table.h"

namespace herr {
namespace {

// Luminances by hundredths of a stop, over all that half floats can tell apart.
constexpr int kPerStop = 100, kDarkest_ev = -30, kBrightest_ev = 18;
constexpr std::size_t kBins = kPerStop * (kBrightest_ev - kDarkest_ev);

double luminance(const std::uint16_t* texel) {
  return 0.2126 * float_from_half(texel[0]) + 0.7152 * float_from_half(texel[1]) +
         0.0722 * float_from_half(texel[2]);
}

class Meter {
 public:
  void add(const ViewportImage& picture) {
    for (int y = 0; y < picture.height_px; ++y) {
      const std::uint16_t* texel = picture.row(y);
      for (int x = 0; x < picture.width_px; ++x, texel += 4) add(texel);
    }
  }

  std::optional<double> ev() const {
    if (!(lit_ > 0)) return std::nullopt;
    double below = all_ - lit_;  // black
    std::size_t bin = 0;
    while (bin + 1 < kBins && below + weights_[bin] < kMeteredShare * all_) below += weights_[bin++];
    const double metered = kDarkest_ev + (static_cast<double>(bin) + 0.5) / kPerStop;
    const double stops = std::log2(kMeteredValue) - metered;
    return std::clamp(std::round(stops * kPerStop) / kPerStop, -kMostExposure_ev, kMostExposure_ev);
  }

 private:
  void add(const std::uint16_t* texel) {
    const double coverage = std::min(1.0, double{float_from_half(texel[3])});
    if (!(coverage > 0)) return;
    all_ += coverage;
    const double value = luminance(texel) / coverage;
    if (!(value > 0) || !std::isfinite(value)) return;
    lit_ += coverage;
    const double bin = (std::log2(value) - kDarkest_ev) * kPerStop;
    weights_[static_cast<std::size_t>(std::clamp(bin, 0.0, double{kBins - 1}))] += coverage;
  }

  std::vector<double> weights_ = std::vector<double>(kBins, 0.0);
  double all_ = 0, lit_ = 0;
};

}  // namespace

std::optional<double> metered_ev(const std::vector<ViewportImage>& pictures, const DisplayProfile& profile) {
  const bool context = std::any_of(profile.viewports.begin(), profile.viewports.end(),
                                   [](const Viewport& viewport) { return !viewport.focus; });
  Meter meter;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (!context || !profile.viewports[i].focus) meter.add(pictures[i]);
  }
  return meter.ev();
}

void choose_exposure(const SessionReport& report, OpenedSession& opened) {
  FrameSample first = opened.session->sample(opened.session->start_ns());
  first.cameras = {};
  opened.player->advance(*opened.session, first.t_ns);
  RenderedFrame frame;
  opened.renderer->render_frame(first, opened.player->state(), frame);
  const std::optional<double> ev = metered_ev(frame.viewports, report.profile);
  if (!ev) opened.scene.warnings.push_back("auto exposure: the first frame shows nothing lit; 0 EV is used");
  opened.scene.exposure = Exposure{true, ev.value_or(0)};  // for further renderers
  opened.renderer->set_exposure(opened.scene.exposure->ev);
  opened.player->restart();
  opened.renderer->restart(opened.player->state());
}

}  // namespace herr
