#include "server/study/relations/light/counted_pictures.h"

#include <utility>

#include "server/study/relations/picture_distance.h"

namespace herr {

std::vector<LinearPicture> CountedPictures::of(const RelationCase& subject) {
  return next(*renderer_of(subject), subject);
}

std::vector<LinearPicture> CountedPictures::next(Renderer& renderer, const RelationCase& subject) {
  RenderedFrame frame;
  renderer.render_frame(subject.sample, subject.state, frame);
  std::vector<LinearPicture> pictures(frame.viewports.size());
  for (std::size_t v = 0; v < pictures.size(); ++v) read_viewport(frame.viewports[v], pictures[v]);
  no_numbers_ += static_cast<double>(frame.counters.nonfinite_values + frame.counters.invalid_rays) +
                 values_not_finite(pictures, subject.profile).error;
  cut_paths_ += frame.counters.cut_paths;
  return pictures;
}

Relation only_numbers(std::string name, std::string holds) {
  Relation relation;
  relation.name = std::move(name);
  relation.holds = std::move(holds);
  relation.unit = "values and rays that are no numbers";
  relation.bound_from = "every value and every ray is a number";
  return relation;
}

}  // namespace herr
