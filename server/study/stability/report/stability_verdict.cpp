#include "server/study/stability/report/stability_verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/process/exit_code.h"
#include "server/study/report/figure_text.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr double kShareInTimes = 10;  // larger shares are told as multiples
constexpr std::size_t kLongestBound = 6;

// An error that is no number lies beyond every share.
double sortable_share(const RelationResult& result) {
  const double share = result.share_of_bound();
  return std::isnan(share) ? std::numeric_limits<double>::infinity() : share;
}

int severity(const RelationResult& result) {
  if (result.holds()) return 0;
  return result.counts() ? 2 : 1;
}

void append_count(std::string& text, int count, const std::string& one, const std::string& several) {
  if (count == 0) return;
  text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + (count == 1 ? one : several);
}

}  // namespace

void RelationCounts::add(const RelationResult& result) {
  if (!result.asked()) {
    ++not_applicable;
  } else if (result.holds()) {
    ++hold;
  } else if (result.counts()) {
    ++fail;
  } else {
    ++fail_off;
  }
}

RelationCounts counts_of(std::span<const RelationResult> results) {
  RelationCounts counts;
  for (const RelationResult& result : results) counts.add(result);
  return counts;
}

const char* name_of(RelationKind kind) {
  switch (kind) {
    case RelationKind::exact:
      return "exact";
    case RelationKind::statistical:
      return "statistical";
    case RelationKind::measured:
      return "measured";
  }
  return "";
}

std::string counts_text(const RelationCounts& counts) {
  std::string text;
  append_count(text, counts.fail, "FAILS", "FAIL");
  append_count(text, counts.fail_off, "fails of what is off in this run", "fail of what is off in this run");
  append_count(text, counts.hold, "holds", "hold");
  append_count(text, counts.not_applicable, "not applicable", "not applicable");
  return text.empty() ? "no relations" : text;
}

std::string verdict_text(const RelationResult& result) {
  if (!result.asked()) return "not applicable";
  if (result.holds()) return "holds";
  return result.counts() ? "FAILS" : "fails (off in this run: " + result.relation.option + ")";
}

std::string error_figure(double error) {
  if (std::isnan(error)) return "no number";
  if (std::isinf(error)) return error > 0 ? "infinite" : "-infinite";
  return figure(error);
}

std::string bound_figure(double bound) {
  const std::string text = shortest_text(bound);
  return std::isfinite(bound) && text.size() <= kLongestBound ? text : error_figure(bound);
}

std::string share_text(const RelationResult& result) {
  if (!result.asked()) return kNoFigure;
  const double share = result.share_of_bound();
  if (!std::isfinite(share)) return kNoFigure;
  if (share < kShareInTimes) return percent_figure(share);
  return figure(share) + " times";
}

std::string failure_line(const RelationResult& result) {
  const Relation& relation = result.relation;
  return result.group + ": " + relation.name + " " + verdict_text(result) + ": " +
         error_figure(result.error) + ", bound " + bound_figure(relation.bound) + " (" + relation.unit + ")" +
         (result.where.empty() ? "" : "; " + result.where);
}

const RelationResult* closest_to_limit(std::span<const RelationResult> results) {
  const RelationResult* closest = nullptr;
  for (const RelationResult& result : results) {
    if (!result.counts() || !result.holds() || !(result.relation.bound > 0)) continue;
    if (closest == nullptr || result.share_of_bound() > closest->share_of_bound()) closest = &result;
  }
  return closest;
}

std::string closest_text(std::span<const RelationResult> results) {
  const RelationResult* closest = closest_to_limit(results);
  if (closest == nullptr) return "no relation holds within a bound above 0";
  if (!(closest->error > 0)) return "none: every error is 0";
  return closest->group + ", " + closest->relation.name + ": " + share_text(*closest) + " of its bound";
}

std::vector<const RelationResult*> worst_first(std::span<const RelationResult> results) {
  std::vector<const RelationResult*> sorted;
  for (const RelationResult& result : results) {
    if (result.asked()) sorted.push_back(&result);
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const RelationResult* a, const RelationResult* b) {
    if (severity(*a) != severity(*b)) return severity(*a) > severity(*b);
    return sortable_share(*a) > sortable_share(*b);
  });
  return sorted;
}

int stability_exit_code(std::span<const RelationResult> results) {
  return counts_of(results).fail > 0 ? kExitRegression : kExitDone;
}

}  // namespace herr
