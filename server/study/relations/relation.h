// A relation: what must hold between pictures (or numbers) of one scene and session, whatever they are. Each
// is measured as an error that is held to a bound. Before: a group of relations measures one. After: the
// stability report.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/study/error/linear_picture.h"

namespace herr {

struct FramePlan;
struct RelationCase;  // relation_case.h

// exact: no chance is involved, the bound is derived. statistical: means over at least 16 seeds, held to 4
// standard errors. measured: exact, but in this scene rounding alone changes more than the derived bound
// (glass behind glass, surfaces that coincide): held to a multiple of what it was measured to change, with a
// ceiling.
enum class RelationKind : std::uint8_t { exact, statistical, measured };

struct Relation {
  std::string name;   // unique, of the user's words: "moved by 1e6 m"
  std::string holds;  // one sentence: what must hold
  RelationKind kind = RelationKind::exact;
  double bound = 0;        // the largest error that is no fault
  std::string unit;        // of error and bound: "share of pixels beyond one 8-bit step", "standard errors"
  std::string bound_from;  // one sentence: why the bound is this
  // Empty: of every run. Else what must be switched on for it to count in the verdict, in words: "adaptive
  // light samples"; the settings at hand have it off, and the relation is measured all the same.
  std::string option;
};

// Pictures of one viewport that ought to be the same, or as the caption says.
struct RelationPictures {
  std::string caption;  // one sentence
  LinearPicture got, wanted;
};

struct RelationResult {
  std::string group;  // RelationGroup::name
  Relation relation;
  std::string not_applicable;  // why it was not asked, in the frame plan's words; empty: it was
  double error = 0;            // not a number: it could not be measured, which is a fault
  std::string where;  // the worst place: "left_context, pixel (3, 5): 0.2 instead of 0.3"; may be empty
  std::optional<RelationPictures> pictures;
  double seconds = 0;

  bool asked() const { return not_applicable.empty(); }
  bool holds() const { return !asked() || error <= relation.bound; }  // false for no number
  bool counts() const { return asked() && relation.option.empty(); }  // in the verdict
  // How much of the bound the error takes, for "which is closest to its limit". A bound of 0: 0 or infinite.
  double share_of_bound() const;
};

// Takes what groups measure, in order.
class RelationLog {
 public:
  // `tell` (may be empty) hears of each result as it comes.
  explicit RelationLog(std::function<void(const RelationResult&)> tell = {}) : tell_(std::move(tell)) {}

  void begin_group(std::string name);
  void measured(Relation relation, double error, std::string where = {},
                std::optional<RelationPictures> pictures = {});
  void not_applicable(Relation relation, std::string why);

  const std::vector<RelationResult>& results() const { return results_; }
  std::vector<RelationResult> take() { return std::move(results_); }

 private:
  void add(RelationResult result);

  std::function<void(const RelationResult&)> tell_;
  std::string group_;
  std::int64_t last_ns_ = 0;  // steady time of the last result
  std::vector<RelationResult> results_;
};

// Relations that are asked together. Groups share nothing: each measures what it needs from the case.
struct RelationGroup {
  const char* name;      // of --only
  const char* sentence;  // what it asks
  void (*measure)(const RelationCase& subject, RelationLog& log);
};
std::span<const RelationGroup> relation_groups();

// Why the plan leaves `entry` out: its reason. Empty when it runs. Throws std::invalid_argument for no entry
// of it.
std::string why_left_out(const FramePlan& plan, const std::string& entry);

}  // namespace herr
