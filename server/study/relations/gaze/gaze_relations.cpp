// Wherever the eye looks every pixel has data: gaze, polar widths and viewports at their limits.
#include <algorithm>
#include <utility>

#include "server/study/relations/gaze/gaze_cases.h"
#include "server/study/relations/gaze/gaze_widths.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr double kHalfRounding = 0x1p-11;  // of a value up to 1
constexpr int kSingleViewport_px = 64;

// What is kept of the worst frame.
struct WorstFrame {
  PictureDistance distance;
  std::string when;

  void offer(PictureDistance found, const std::string& of) {
    if (found.error <= distance.error) return;
    distance = std::move(found), when = of;
  }
  std::string where() const { return distance.where.empty() ? "" : when + ": " + distance.where; }
};

class GazeRelations {
 public:
  GazeRelations(const DrawFrame& draw, const RelationCase& subject, RelationLog& log)
      : draw_(draw), subject_(subject), log_(log) {}

  void measure() {
    const std::string why = why_left_out(plan_of(subject_), "log-polar rays");
    if (!why.empty()) {
      Relation relation = data_relation("any gaze and width");
      log_.not_applicable(std::move(relation), why);
      return;
    }
    measure_data();
    measure_coverage();
    measure_no_direction();
    measure_jumps();
    invalid_ += measure_gaze_widths(draw_, subject_, log_);
    tell_counters();
  }

 private:
  // The next frame of a renderer, or the first of one as new: nothing that an earlier frame left shows.
  const RenderedFrame& next(Renderer& renderer, const RelationCase& subject, int width = 0) {
    FrameQuality quality = renderer.full_quality();
    if (width > 0) quality.polar_width = width;
    draw_(renderer, subject, quality, frame_);
    invalid_ += static_cast<double>(frame_.counters.invalid_rays + frame_.counters.nonfinite_values);
    return frame_;
  }
  const RenderedFrame& first(Renderer& renderer, const RelationCase& subject, int width = 0) {
    renderer.restart(subject.state);
    return next(renderer, subject, width);
  }
  std::vector<LinearPicture> pictures() const {
    std::vector<LinearPicture> out(frame_.viewports.size());
    for (std::size_t i = 0; i < out.size(); ++i) read_viewport(frame_.viewports[i], out[i]);
    return out;
  }

  // Polar buffers of the height of `subject`, of these widths: one frame for each gaze and width.
  template <typename Measure>
  void draw_white(RelationCase subject, const std::vector<int>& widths, const Measure& measure) {
    RenderSettings& settings = subject.settings;
    settings.polar_width = *std::max_element(widths.begin(), widths.end());
    settings.polar_acuity = false;
    const std::vector<NamedGaze> gazes = gazes_at_limits(subject);
    Renderer renderer(subject.scene, subject.profile, settings, false);
    for (std::size_t g = 0; g < gazes.size(); ++g) {
      subject.sample.gaze = gazes[g].gaze;
      for (const int width : widths) {
        first(renderer, subject, width);
        measure(g, "gaze " + gazes[g].name + ", buffer of " + std::to_string(width) + " x " +
                       std::to_string(settings.polar_height));
      }
    }
  }

  void measure_data() {
    const RelationCase white = white_case(subject_);
    const PolarSize most = largest_polar_size();
    const RenderSettings& usual = subject_.settings;
    const std::vector<NamedGaze> gazes = gazes_at_limits(white);
    std::vector<WorstFrame> worst(gazes.size());
    for (const auto& [height, widths] : {std::pair<int, std::vector<int>>{2, {1, 8, most.width}},
                                         {usual.polar_height, {1, 8, usual.polar_width}},
                                         {most.height, {1, 8}}}) {
      RelationCase at = white;
      at.settings.polar_height = height;
      draw_white(at, widths, [&](std::size_t g, const std::string& when) {
        worst[g].offer(farthest_from_white(frame_, at.profile), when);
      });
    }
    for (std::size_t g = 0; g < gazes.size(); ++g) tell_data("gaze " + gazes[g].name, worst[g]);
    for (const double degrees : {1.0, 179.0}) {
      RelationCase at = white;
      at.profile = single_viewport(degrees, kSingleViewport_px);
      WorstFrame of_view;
      draw_white(at, {1, 8, usual.polar_width}, [&](std::size_t, const std::string& when) {
        of_view.offer(farthest_from_white(frame_, at.profile), when);
      });
      tell_data("a viewport of " + shortest_text(degrees) + (degrees == 1 ? " degree" : " degrees"), of_view);
    }
  }

  static Relation data_relation(const std::string& what) {
    Relation relation;
    relation.name = "every pixel has data: " + what;
    relation.holds =
        "where every surface and all behind them show 1, every pixel is 1 in every channel, at polar "
        "widths of 1, 8, the usual and the largest, and heights of 2, the usual and the largest";
    relation.bound = kHalfRounding;
    relation.unit = "largest distance from 1";
    relation.bound_from =
        "equal samples blend to their own value, and a sample of 1 is rounded to a half float once: 2^-11";
    return relation;
  }
  void tell_data(const std::string& what, const WorstFrame& worst) {
    log_.measured(data_relation(what), worst.distance.error, worst.where());
  }

  void measure_coverage() {
    const RelationCase over_nothing = white_over_nothing(subject_);
    WorstFrame worst;
    draw_white(over_nothing, {1, 8, over_nothing.settings.polar_width},
               [&](std::size_t, const std::string& when) {
                 worst.offer(farthest_from_coverage(frame_, over_nothing.profile), when);
               });
    Relation relation;
    relation.name = "white surfaces over nothing are their coverage";
    relation.holds =
        "where every surface shows 1 over nothing, colour is the coverage, for any gaze and width";
    relation.bound = 2 * kHalfRounding;
    relation.unit = "largest distance of colour and coverage";
    relation.bound_from = "both are sums of the same weights, each rounded to a half float: 2^-11 twice";
    log_.measured(relation, worst.distance.error, worst.where());
  }

  void measure_no_direction() {
    RelationCase own = own_surfaces(subject_);
    own.sample.gaze = gaze_ahead(own.sample);
    Renderer renderer(own.scene, own.profile, own.settings, false);
    next(renderer, own);
    const std::vector<LinearPicture> wanted = pictures();
    PictureDistance worst;
    for (const SampledGaze& gaze : gazes_of_no_direction()) {
      own.sample.gaze = gaze;
      next(renderer, own);
      PictureDistance found = differing_values(pictures(), wanted, own.profile);
      if (found.error > worst.error) worst = std::move(found);
    }
    Relation relation;
    relation.name = "a gaze of no direction";
    relation.holds = "a gaze that is not a number, infinite or of no length is taken as straight ahead";
    relation.bound = 0;
    relation.unit = "values that differ";
    relation.bound_from = "the same frame is drawn";
    log_.measured(relation, worst.error, worst.where);
  }

  void measure_jumps() {
    RelationCase own = own_surfaces(subject_);
    const std::vector<NamedGaze> gazes = gazes_at_limits(own);
    std::vector<std::vector<LinearPicture>> wanted;
    for (const NamedGaze& gaze : gazes) {
      own.sample.gaze = gaze.gaze;
      Renderer renderer(own.scene, own.profile, own.settings, false);
      next(renderer, own);
      wanted.push_back(pictures());
    }
    Renderer renderer(own.scene, own.profile, own.settings, false);
    PictureDistance worst;
    std::string when;
    std::vector<LinearPicture> got_worst, wanted_worst;
    // Neighbours in this order are each pair of gazes at least once, one way or the other.
    for (const std::size_t g : {0u, 1u, 2u, 3u, 4u, 0u, 2u, 4u, 1u, 3u, 0u}) {
      own.sample.gaze = gazes[g].gaze;
      next(renderer, own);
      const std::vector<LinearPicture> got = pictures();
      PictureDistance found = differing_values(got, wanted[g], own.profile);
      if (found.error <= worst.error) continue;
      worst = std::move(found), when = "gaze " + gazes[g].name + ": ";
      got_worst = got, wanted_worst = wanted[g];
    }
    Relation relation;
    relation.name = "gaze that jumps each frame";
    relation.holds = "a renderer whose gaze jumps shows at each frame what a new one shows";
    relation.bound = 0;
    relation.unit = "values that differ";
    relation.bound_from = "without probes and coarser meshes a frame leaves nothing for the next one";
    std::optional<RelationPictures> shown;
    if (worst.error > 0)
      shown = worst_pictures(worst, got_worst, wanted_worst, "after a jump | by a new renderer | difference");
    log_.measured(relation, worst.error, worst.where.empty() ? "" : when + worst.where, std::move(shown));
  }

  void tell_counters() {
    Relation relation;
    relation.name = "rays and values are finite for any gaze, width and viewport";
    relation.holds = "no ray of these frames is invalid, and no stage makes a value that is not finite";
    relation.bound = 0;
    relation.unit = "invalid rays and values";
    relation.bound_from = "directions and weights are finite wherever the gaze lies";
    log_.measured(relation, invalid_);
  }

  const DrawFrame& draw_;
  const RelationCase& subject_;
  RelationLog& log_;
  RenderedFrame frame_;
  double invalid_ = 0;
};

}  // namespace

void measure_gaze_by(const DrawFrame& draw, const RelationCase& subject, RelationLog& log) {
  GazeRelations(draw, subject, log).measure();
}

void measure_gaze(const RelationCase& subject, RelationLog& log) {
  measure_gaze_by([](Renderer& renderer, const RelationCase& of, const FrameQuality& quality,
                     RenderedFrame& out) { renderer.render_frame(of.sample, of.state, quality, out); },
                  subject, log);
}

}  // namespace herr
