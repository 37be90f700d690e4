// Pictures of which is counted what their values no longer tell: stages replace values that are no numbers,
// and end paths through glass at a limit. Before: RelationCase. After: relations about light and surfaces.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/study/relations/relation.h"
#include "server/study/relations/relation_case.h"

namespace herr {

class CountedPictures {
 public:
  std::vector<LinearPicture> of(const RelationCase& subject);  // as picture_of
  std::vector<LinearPicture> next(Renderer& renderer, const RelationCase& subject);

  // Of all pictures so far: values and rays, and what a picture itself still has.
  double no_numbers() const { return no_numbers_; }
  std::int64_t cut_paths() const { return cut_paths_; }

 private:
  double no_numbers_ = 0;
  std::int64_t cut_paths_ = 0;
};

// That there are none of them.
Relation only_numbers(std::string name, std::string holds);

}  // namespace herr
