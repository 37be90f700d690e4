// The case that relations are asked of: one frame of the user's session and scene. Before: StudyOptions.
// After: relation_groups.
#pragma once

#include <string>
#include <vector>

#include "server/study/relations/relation_case.h"
#include "server/study/study_options.h"
#include "server/study/study_subject.h"

namespace herr {

// Opens session and scene as `herr replay` does and takes the frame with much to see. An object of this kind
// stays where it is.
class StabilityCase {
 public:
  // Throws InputError and UsageError.
  explicit StabilityCase(const StudyOptions& options);

  const RelationCase& relations() const { return case_; }
  const SessionReport& report() const { return subject_.report(); }
  // Of session and scene; and where the frame shows one colour everywhere, of which most relations hold.
  std::vector<std::string> warnings() const;
  const StudyFrame& frame() const { return subject_.frames().frames.front(); }

 private:
  StudySubject subject_;  // its session holds what the sample refers to
  RelationCase case_;
};

}  // namespace herr
