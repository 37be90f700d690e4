#include "server/study/reference/reference_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "server/output/srgb_table.h"
#include "server/process/steady_time.h"
#include "server/study/error/acuity_filter.h"
#include "server/study/error/picture_errors.h"

namespace herr {
namespace {

constexpr double kShareOfSmallest = 1.0 / 5;
constexpr int kFewestPasses = 2, kMostPasses = 512;  // of each half

// One half: a renderer, by default with probes of its own seed, and the sum of its passes.
struct HalfSum {
  std::unique_ptr<Renderer> renderer;
  std::vector<LinearPicture> sum;
  std::vector<int> passes;  // of each tile
  int next = 0;             // pass
};

class Halves {
 public:
  Halves(const ReferenceSpec& spec, const FrameInstant& instant);

  void add_passes(int count, const std::vector<std::uint8_t>& tiles);
  // Acuity-weighted error of the mean, of the passes so far.
  double acuity_error();
  // Tiles whose halves differ by more than `share` of the mean difference: 1.
  std::vector<std::uint8_t> tiles_above(double share) const;
  double error_of(const RenderSettings& settings);
  ReferenceHalves take();
  int most_passes() const { return halves_[0].next; }

 private:
  void add(const RenderedFrame& frame, HalfSum& half, const std::vector<std::uint8_t>& tiles);
  std::vector<LinearPicture> mean_of(const HalfSum& half) const;
  ParallelFor threads() { return threads_of(*halves_[0].renderer); }

  const ReferenceSpec& spec_;
  const FrameInstant& instant_;
  HalfSum halves_[2];
  std::vector<PixelTile> tiles_;  // one for each viewport where passes are frames
  RenderedFrame frame_;
};

Halves::Halves(const ReferenceSpec& spec, const FrameInstant& instant) : spec_(spec), instant_(instant) {
  for (std::size_t h = 0; h < 2; ++h) {
    RenderSettings settings = spec.settings;
    if (!spec.same_probes) settings.seed = spec.settings.seed + 1 + static_cast<std::uint32_t>(h);
    HalfSum& half = halves_[h];
    half.renderer = renderer_at(instant, settings);
    // Takes scene and probes to the instant; it is no pass.
    half.renderer->render_frame(*instant.sample, *instant.state, frame_);
    for (const Viewport& v : instant.profile->viewports) {
      LinearPicture black{v.width_px, v.height_px, {}};
      for (auto& plane : black.plane) plane.assign(black.pixels(), 0.0f);
      half.sum.push_back(std::move(black));
    }
  }
  if (spec.by_pixels) {
    tiles_ = halves_[0].renderer->pixel_tiles();
  } else {
    int viewport = 0;
    for (const Viewport& v : instant.profile->viewports)
      tiles_.push_back({viewport++, 0, 0, v.width_px, v.height_px});
  }
  for (HalfSum& half : halves_) half.passes.assign(tiles_.size(), 0);
}

void Halves::add(const RenderedFrame& frame, HalfSum& half, const std::vector<std::uint8_t>& tiles) {
  threads()(static_cast<int>(tiles_.size()), [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    if (!tiles.empty() && tiles[index] == 0) return;
    const PixelTile& tile = tiles_[index];
    const ViewportImage& image = frame.viewports[static_cast<std::size_t>(tile.viewport)];
    LinearPicture& sum = half.sum[static_cast<std::size_t>(tile.viewport)];
    for (int y = tile.y0; y < tile.y1; ++y) {
      const std::uint16_t* texel = image.row(y) + 4 * tile.x0;
      std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(sum.width_px) +
                       static_cast<std::size_t>(tile.x0);
      for (int x = tile.x0; x < tile.x1; ++x, ++at, texel += 4) {
        for (std::size_t c = 0; c < 3; ++c) sum.plane[c][at] += float_from_half(texel[c]);
      }
    }
    ++half.passes[index];
  });
}

void Halves::add_passes(int count, const std::vector<std::uint8_t>& tiles) {
  for (int i = 0; i < count; ++i) {
    for (std::uint32_t h = 0; h < 2; ++h) {
      HalfSum& half = halves_[h];
      PixelPass pass;
      pass.seed = spec_.settings.seed + 3 + 2 * static_cast<std::uint32_t>(half.next) + h;
      pass.jitter = spec_.by_pixels;
      pass.sequence = h;
      pass.index = half.next;
      if (spec_.by_pixels) pass.tiles = tiles;
      half.renderer->render_pass(*instant_.sample, *instant_.state, pass, frame_);
      add(frame_, half, tiles);
      ++half.next;
    }
  }
}

std::vector<LinearPicture> Halves::mean_of(const HalfSum& half) const {
  std::vector<LinearPicture> mean = half.sum;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    const PixelTile& tile = tiles_[t];
    LinearPicture& picture = mean[static_cast<std::size_t>(tile.viewport)];
    const std::vector<std::uint8_t>& band = instant_.maps[static_cast<std::size_t>(tile.viewport)].band;
    const float share = 1.0f / static_cast<float>(std::max(1, half.passes[t]));
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) +
                               static_cast<std::size_t>(x);
        for (auto& plane : picture.plane) {
          plane[at] = band[at] == kNotSeen ? 0.0f : float_from_half(half_from_float(plane[at] * share));
        }
      }
    }
  }
  return mean;
}

double Halves::acuity_error() {
  std::vector<LinearPicture> half[2] = {mean_of(halves_[0]), mean_of(halves_[1])};
  for (auto& pictures : half) {
    for (LinearPicture& picture : pictures) limit_to_white(picture);
  }
  return acuity_weighted_rmse(instant_.maps, half[0], half[1], threads()) / 2;
}

double Halves::error_of(const RenderSettings& settings) {
  const std::unique_ptr<Renderer> renderer = renderer_at(instant_, settings);
  renderer->render_frame(*instant_.sample, *instant_.state, frame_);
  std::vector<LinearPicture> test;
  read_viewports(frame_, instant_, threads(), test);
  std::vector<LinearPicture> mean = mean_of(halves_[0]);
  const std::vector<LinearPicture> other = mean_of(halves_[1]);
  for (std::size_t v = 0; v < mean.size(); ++v) {
    for (std::size_t c = 0; c < 3; ++c) {
      std::vector<float>& plane = mean[v].plane[c];
      for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = 0.5f * (plane[i] + other[v].plane[c][i]);
    }
    limit_to_white(mean[v]);
    limit_to_white(test[v]);
  }
  return acuity_weighted_rmse(instant_.maps, test, mean, threads());
}

// Mean squared difference of the halves, by the pixels that are seen.
std::vector<std::uint8_t> Halves::tiles_above(double share) const {
  std::vector<LinearPicture> a = mean_of(halves_[0]), b = mean_of(halves_[1]);
  for (std::size_t v = 0; v < a.size(); ++v) limit_to_white(a[v]), limit_to_white(b[v]);
  std::vector<double> of_tile(tiles_.size(), 0.0);
  double all = 0, weights = 0;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    const PixelTile& tile = tiles_[t];
    const auto v = static_cast<std::size_t>(tile.viewport);
    const ViewportMap& map = instant_.maps[v];
    double sum = 0, weight_of_tile = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width_px) +
                               static_cast<std::size_t>(x);
        if (map.band[at] == kNotSeen) continue;
        const double weight = acuity_weight(double{map.eccentricity_deg[at]}, double{map.solid_angle_sr[at]});
        for (std::size_t c = 0; c < 3; ++c) {
          const double d = double{a[v].plane[c][at]} - double{b[v].plane[c][at]};
          sum += weight * d * d;
        }
        weight_of_tile += weight;
      }
    }
    of_tile[t] = weight_of_tile > 0 ? sum / weight_of_tile : 0;
    all += sum, weights += weight_of_tile;
  }
  const double limit = weights > 0 ? share * share * all / weights : 0;
  std::vector<std::uint8_t> wanted(tiles_.size());
  for (std::size_t t = 0; t < tiles_.size(); ++t) wanted[t] = of_tile[t] > limit ? 1 : 0;
  return wanted;
}

ReferenceHalves Halves::take() {
  ReferenceHalves out;
  out.passes = halves_[0].next;
  for (const int passes : halves_[0].passes) out.passes = std::min(out.passes, passes);
  out.most_passes = halves_[0].next;
  for (std::size_t h = 0; h < 2; ++h) out.half[h] = mean_of(halves_[h]);
  return out;
}

double seconds_since(TimeNs start_ns) {
  return static_cast<double>(steady_now_ns() - start_ns) * 1e-9;
}

}  // namespace

ReferenceHalves render_halves(const ReferenceSpec& spec, const FrameInstant& instant,
                              const std::function<bool()>& out_of_time,
                              const std::function<bool(double so_far_s, double pass_s)>& one_pass) {
  const TimeNs start_ns = steady_now_ns();
  Halves halves(spec, instant);
  double pass_s = 0;
  const bool may_be_cut = spec.by_pixels && spec.refined;
  bool cut = false;
  for (int pass = 0; pass < spec.passes; ++pass) {
    cut = may_be_cut && ((pass >= kFewestPasses && out_of_time()) ||
                         (pass == 1 && one_pass && one_pass(seconds_since(start_ns), pass_s)));
    if (cut) break;
    const TimeNs pass_ns = steady_now_ns();
    halves.add_passes(1, {});
    pass_s = seconds_since(pass_ns);
  }
  bool met = !spec.by_pixels;
  // The frame of the smallest error takes as long as some passes: not where there was no time for those.
  if (may_be_cut && !cut) {
    double own = halves.acuity_error();
    const double finest = halves.error_of(spec.finest);
    // What the noise of the reference adds to it is no error of the setting.
    const double goal =
        kShareOfSmallest * std::sqrt(std::max(finest * finest - own * own, 0.25 * finest * finest));
    while (!(met = own <= goal) && halves.most_passes() < kMostPasses && !out_of_time()) {
      // A tile may keep what it has when it is no worse than the goal asks of the mean tile.
      const std::vector<std::uint8_t> tiles = halves.tiles_above(own > 0 ? goal / own : 0);
      if (std::find(tiles.begin(), tiles.end(), 1) == tiles.end()) break;
      const int half_as_many = std::max(1, halves.most_passes() / 2);
      halves.add_passes(std::min(half_as_many, kMostPasses - halves.most_passes()), tiles);
      own = halves.acuity_error();
    }
  }
  ReferenceHalves out = halves.take();
  out.goal_met = met;
  out.seconds = seconds_since(start_ns);
  return out;
}

ReferencePicture mean_of_halves(const ReferenceSpec& spec, const FrameInstant& instant,
                                ReferenceHalves halves, const ParallelFor& parallel_for) {
  ReferencePicture out;
  out.spec = spec;
  out.passes = halves.passes, out.most_passes = halves.most_passes;
  out.goal_met = halves.goal_met;
  out.seconds = halves.seconds;
  out.picture = halves.half[0];
  for (std::size_t v = 0; v < out.picture.size(); ++v) {
    for (std::size_t c = 0; c < 3; ++c) {
      std::vector<float>& plane = out.picture[v].plane[c];
      for (std::size_t i = 0; i < plane.size(); ++i)
        plane[i] = 0.5f * (plane[i] + halves.half[1][v].plane[c][i]);
    }
    limit_to_white(out.picture[v]);
    for (auto& half : halves.half) limit_to_white(half[v]);
  }
  out.error = error_of_mean(picture_errors(instant.maps, halves.half[0], halves.half[1], parallel_for));
  return out;
}

}  // namespace herr
