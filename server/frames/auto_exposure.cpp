#include "server/frames/auto_exposure.h"

#include <algorithm>
#include <cmath>

#include "server/frames/opened_session.h"
#include "server/output/exposure.h"

namespace herr {
namespace {

constexpr float kLeastCoverage = 1.0f / 255;  // less is not seen

// Pixels of one picture that something covers, with their colours as they are without that coverage.
void add_covered(const ViewportImage& picture, LightPicture& covered) {
  for (int y = 0; y < picture.height_px; ++y) {
    const std::uint16_t* texel = picture.row(y);
    for (int x = 0; x < picture.width_px; ++x, texel += 4) {
      const float coverage = float_from_half(texel[3]);
      if (!(coverage >= kLeastCoverage)) continue;
      for (std::size_t c = 0; c < 3; ++c) covered.rgba.push_back(float_from_half(texel[c]) / coverage);
      covered.rgba.push_back(1.0f);
      ++covered.width_px;
    }
  }
}

}  // namespace

std::optional<double> metered_ev(const std::vector<ViewportImage>& pictures, const DisplayProfile& profile) {
  const bool context = std::any_of(profile.viewports.begin(), profile.viewports.end(),
                                   [](const Viewport& viewport) { return !viewport.focus; });
  LightPicture covered;
  covered.height_px = 1;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (!context || !profile.viewports[i].focus) add_covered(pictures[i], covered);
  }
  ExposureRule rule;
  rule.most_ev = kMostExposure_ev;
  const std::optional<double> ev = automatic_ev(covered, {}, rule);
  if (!ev) return std::nullopt;
  return std::clamp(std::round(*ev * 100) / 100, -kMostExposure_ev, kMostExposure_ev);
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
