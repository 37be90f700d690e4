#include "server/study/relations/gaze/gaze_widths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "server/study/relations/gaze/gaze_cases.h"
#include "server/study/relations/gaze/near_rays.h"
#include "server/study/relations/relation.h"
#include "server/study/report/figure_text.h"

namespace herr {
namespace {

constexpr double kLeastSquare = 0x1p-22;      // of what half floats round, of values up to 1
constexpr std::array kWidths{1, 8, 64, 512};  // whose errors are compared
constexpr double kNoiseRatio = 2 / 1.25;
constexpr double kStandardErrorsOfWidths = 4;
// Of the least error of a narrow buffer, squared: beyond it the picture is noise to samples a pixel apart.
constexpr double kContrastRatio = 4, kFallRatio = 2;
constexpr double kGazesWithin_deg = 10, kGazesAheadWithin_deg = 0.5;

double mean_of_squares(const std::vector<double>& squares) {
  double sum = 0;
  for (const double square : squares) sum += square;
  return sum / static_cast<double>(squares.size());
}

// By how many standard errors the mean lies above 0; 0 where it does not.
double above_zero(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  const double mean = mean_of_squares(values);
  double spread = 0;
  for (const double value : values) spread += (value - mean) * (value - mean);
  if (mean <= 0) return 0;
  return mean / std::sqrt(spread / (count * (count - 1)));
}

std::string root_text(double square) {
  return figure(std::sqrt(square));
}

Relation of_standard_errors(std::string name, std::string holds, std::string bound_from) {
  Relation relation;
  relation.name = std::move(name);
  relation.holds = std::move(holds);
  relation.kind = RelationKind::statistical;
  relation.bound = kStandardErrorsOfWidths;
  relation.unit = "standard errors";
  relation.bound_from = std::move(bound_from);
  return relation;
}

// Rays of no width: then textures and voxels are the same function of the direction for any buffer.
RelationCase sampled_case(const RelationCase& subject) {
  RelationCase own = own_surfaces(subject);
  own.settings.ray_width = 0;
  own.settings.filter = ResampleFilter::bilinear;
  own.settings.gaze_marker = own.settings.debug_tiles = false;
  own.settings.covered_pixels = true;
  return own;
}

RelationCase one_ray_per_pixel(RelationCase subject) {
  subject.settings.foveation = Foveation::off;
  subject.settings.scale = 1;
  return subject;
}

// Of one display: errors of polar buffers against one ray per pixel.
class WidthErrors {
 public:
  WidthErrors(const DrawFrame& draw, RelationCase own, double within_deg)
      : draw_(draw), own_(std::move(own)), gazes_(gazes_around(own_.sample, within_deg)) {
    const RelationCase by_pixel = one_ray_per_pixel(own_);
    Renderer renderer(by_pixel.scene, by_pixel.profile, by_pixel.settings, false);
    next(renderer, by_pixel, renderer.full_quality().polar_width);
    wanted_ = pictures();
    near_ = mean_square_of_near_rays(by_pixel, wanted_);
  }

  // Squares of the error of each of 16 gazes, for each width.
  std::vector<std::vector<double>> of_widths(int height, const std::vector<int>& widths) {
    RelationCase own = own_;
    own.settings.polar_width = *std::max_element(widths.begin(), widths.end());
    own.settings.polar_height = height;
    own.settings.polar_acuity = false;
    Renderer renderer(own.scene, own.profile, own.settings, false);
    std::vector<std::vector<double>> squares(widths.size());
    for (const SampledGaze& gaze : gazes_) {
      own.sample.gaze = gaze;
      for (std::size_t w = 0; w < widths.size(); ++w) {
        next(renderer, own, widths[w]);
        last_ = pictures();
        const double error = rms_difference(last_, wanted_);
        squares[w].push_back(error * error);
      }
    }
    return squares;
  }

  // Finer than pixels for each of the gazes.
  PolarSize fine_size() const {
    RelationCase own = own_;
    PolarSize size;
    for (const SampledGaze& gaze : gazes_) {
      own.sample.gaze = gaze;
      const PolarSize of_gaze = finer_than_pixels(own);
      size = {std::max(size.width, of_gaze.width), std::max(size.height, of_gaze.height)};
    }
    return size;
  }

  double near() const { return near_; }
  double invalid() const { return invalid_; }
  // The last frame that was drawn, beside one ray per pixel.
  RelationPictures shown() const {
    return worst_pictures(largest_relative(last_, wanted_, 1, own_.profile), last_, wanted_,
                          "polar samples | one ray per pixel | difference");
  }

 private:
  void next(Renderer& renderer, const RelationCase& of, int width) {
    FrameQuality quality = renderer.full_quality();
    quality.polar_width = width;
    draw_(renderer, of, quality, frame_);
    invalid_ += static_cast<double>(frame_.counters.invalid_rays + frame_.counters.nonfinite_values);
  }
  std::vector<LinearPicture> pictures() const {
    std::vector<LinearPicture> out(frame_.viewports.size());
    for (std::size_t i = 0; i < out.size(); ++i) read_viewport(frame_.viewports[i], out[i]);
    return out;
  }

  const DrawFrame& draw_;
  RelationCase own_;
  std::vector<SampledGaze> gazes_;
  std::vector<LinearPicture> wanted_, last_;
  RenderedFrame frame_;
  double near_ = 0, invalid_ = 0;
};

void tell_width(int narrow, const std::vector<double>& narrow_squares, int wide,
                const std::vector<double>& wide_squares, RelationLog& log) {
  const Relation relation = of_standard_errors(
      "error at polar width " + std::to_string(wide) + " against " + std::to_string(narrow),
      "over 16 gazes within 10 degrees of the user's, the mean square error against one ray per pixel is at "
      "most 1.6 times that of a polar buffer an eighth as wide",
      "wherever the samples fall, on the mean nearer ones tell more; of mere noise a pixel is off by its "
      "variance times 1 + the sum of the squared weights of four samples, 1.25 to 2, whatever the width");
  std::vector<double> beyond(wide_squares.size());
  for (std::size_t i = 0; i < beyond.size(); ++i)
    beyond[i] = wide_squares[i] - kNoiseRatio * std::max(narrow_squares[i], kLeastSquare);
  log.measured(relation, above_zero(beyond),
               "RMS " + root_text(mean_of_squares(wide_squares)) + " after " +
                   root_text(mean_of_squares(narrow_squares)));
}

void tell_fine(const WidthErrors& errors, const std::vector<double>& fine, const std::string& size,
               const std::string& display, RelationLog& log) {
  const Relation relation = of_standard_errors(
      "error of a buffer finer than pixels" + display,
      "over 16 gazes about the user's, or straight ahead, polar samples nearer to one another than pixels "
      "differ from one ray per pixel by no "
      "more than rays that pass up to a pixel away, in the mean square",
      "a pixel is a mean of samples whose weights fall off linearly to 0 a pixel away; the square of a mean "
      "is at most the mean of the squares, here of rays that pass as the weights have it");
  std::vector<double> beyond(fine.size());
  for (std::size_t i = 0; i < beyond.size(); ++i) beyond[i] = fine[i] - std::max(errors.near(), kLeastSquare);
  log.measured(relation, above_zero(beyond),
               size + " samples, RMS " + root_text(mean_of_squares(fine)) + ", of rays near by " +
                   root_text(errors.near()),
               errors.shown());
}

void tell_fall(const WidthErrors& errors, const std::vector<double>& narrow, const std::vector<double>& fine,
               const std::string& display, RelationLog& log) {
  const Relation relation = of_standard_errors(
      "the error falls with polar width" + display,
      "over 16 gazes, the mean square error of a buffer finer than pixels is at most half of that of one as "
      "high and 1 sample wide",
      "asked where rays near by differ by at most a quarter of the narrow buffer's mean square error, which "
      "bounds that of the fine one");
  const double least = kContrastRatio * std::max(errors.near(), kLeastSquare);
  const std::string found = "of rays near by RMS " + root_text(errors.near()) + ", of a buffer 1 wide " +
                            root_text(mean_of_squares(narrow));
  if (mean_of_squares(narrow) < least)
    return log.not_applicable(relation, "what is seen has no contrast wider than a pixel: " + found);
  std::vector<double> beyond(fine.size());
  for (std::size_t i = 0; i < beyond.size(); ++i) beyond[i] = fine[i] - narrow[i] / kFallRatio;
  log.measured(relation, above_zero(beyond), "RMS " + root_text(mean_of_squares(fine)) + "; " + found);
}

// Buffers as fine as the display needs.
void measure_fine(WidthErrors& errors, const PolarSize& size, const std::string& display, RelationLog& log) {
  const auto squares = errors.of_widths(size.height, {1, size.width});
  tell_fine(errors, squares[1], std::to_string(size.width) + " x " + std::to_string(size.height), display,
            log);
  tell_fall(errors, squares[0], squares[1], display, log);
}

}  // namespace

double measure_gaze_widths(const DrawFrame& draw, const RelationCase& subject, RelationLog& log) {
  const RelationCase own = sampled_case(subject);
  WidthErrors errors(draw, own, kGazesWithin_deg);
  const auto squares =
      errors.of_widths(own.settings.polar_height, std::vector<int>(kWidths.begin(), kWidths.end()));
  for (std::size_t w = 1; w < kWidths.size(); ++w)
    tell_width(kWidths[w - 1], squares[w - 1], kWidths[w], squares[w], log);
  measure_fine(errors, errors.fine_size(), "", log);

  constexpr int kNarrowPixels = 16, kWidePixels = 9;  // so few that 8192 samples along each axis are enough
  RelationCase view = own;
  view.sample.gaze = gaze_ahead(view.sample);
  view.profile = single_viewport(1, kNarrowPixels);
  WidthErrors narrow_view(draw, view, kGazesWithin_deg);
  measure_fine(narrow_view, narrow_view.fine_size(), ", a viewport of 1 degree", log);
  view.profile = single_viewport(179, kWidePixels);
  WidthErrors wide_view(draw, view, kGazesAheadWithin_deg);
  measure_fine(wide_view, finer_than_pixels_ahead(179, kWidePixels, kGazesAheadWithin_deg),
               ", a viewport of 179 degrees", log);
  return errors.invalid() + narrow_view.invalid() + wide_view.invalid();
}

}  // namespace herr
