// What results of relations say together. Pure. Before: RelationResult. After: stdout, page, exit code.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "server/study/relations/relation.h"

namespace herr {

struct RelationCounts {
  int hold = 0, fail = 0;
  int fail_off = 0;  // of an option that this run has off: they do not decide
  int not_applicable = 0;

  void add(const RelationResult& result);
  int all() const { return hold + fail + fail_off + not_applicable; }
};
RelationCounts counts_of(std::span<const RelationResult> results);

const char* name_of(RelationKind kind);  // "exact", "statistical"

// "31 hold, 1 fails, 5 not applicable"
std::string counts_text(const RelationCounts& counts);

// "holds", "FAILS", "not applicable", "fails (off in this run: adaptive light samples)"
std::string verdict_text(const RelationResult& result);
// 0.03 as "3 %", above 10 as "27 times", NaN as "no number".
std::string share_text(const RelationResult& result);
// As figure(), with what is not finite in words.
std::string error_figure(double error);
// As it was stated: "0.001"; of long ones three digits.
std::string bound_figure(double bound);

// "light: two lights give their sum FAILS: 0.3, bound 0.001 (largest relative difference); left, pixel ..."
std::string failure_line(const RelationResult& result);

// Of those that hold the one that takes most of its bound; null where none has a bound to take a share of.
const RelationResult* closest_to_limit(std::span<const RelationResult> results);
// "place, moved by 1e8 m: 83 % of its bound"; says so where there is none.
std::string closest_text(std::span<const RelationResult> results);

// Those that were asked, worst first: failures that count, other failures, then by share of their bound.
std::vector<const RelationResult*> worst_first(std::span<const RelationResult> results);

// kExitDone, or kExitRegression when a relation fails that counts.
int stability_exit_code(std::span<const RelationResult> results);

}  // namespace herr
