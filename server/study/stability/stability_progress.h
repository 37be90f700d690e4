// What a stability report is at. On a terminal: one line that is redrawn. Elsewhere: one line a group when it
// ends. Before: measure_groups. After: stderr.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "server/study/relations/relation.h"
#include "server/study/stability/report/stability_verdict.h"

namespace herr {

// Pure: "stability [####----------------]  place (2 of 10): moved by 1e8 m  0:42".
std::string stability_progress_text(std::size_t group, std::size_t groups, const std::string& what,
                                    double seconds);

// A relation that fails is told at once, everywhere.
class StabilityProgress {
 public:
  explicit StabilityProgress(std::size_t groups);
  ~StabilityProgress();  // clears the line
  StabilityProgress(const StabilityProgress&) = delete;
  StabilityProgress& operator=(const StabilityProgress&) = delete;

  void begin_group(const RelationGroup& group);
  void tell(const RelationResult& result);
  void end();

 private:
  void draw(const std::string& what) const;

  const bool drawn_;
  const std::size_t groups_;
  const std::int64_t start_ns_;
  std::int64_t group_start_ns_ = 0;
  std::size_t group_ = 0;  // from 1
  std::string name_;       // of the group; empty before the first
  RelationCounts counts_;
};

}  // namespace herr
