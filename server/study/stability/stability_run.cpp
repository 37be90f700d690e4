#include "server/study/stability/stability_run.h"

#include <algorithm>
#include <limits>

#include "server/process/exit_code.h"
#include "sessions/files/input_error.h"
#include "sessions/files/nearest_name.h"

namespace herr {
namespace {

// Not a std::exception: a relation that expects some must not take it for one.
struct StopAsked {};

void measure_group(const RelationGroup& group, const RelationCase& subject, RelationLog& log) {
  try {
    group.measure(subject, log);
  } catch (const StopAsked&) {
    throw;
  } catch (...) {
    std::string message;
    if (exit_code_of_current_exception(message) == kExitTemporary) throw;
    Relation relation;
    relation.name = "the rest of the group";
    relation.holds = "every relation can be measured";
    relation.unit = "no number";
    relation.bound_from = "what ends a relation is a fault";
    log.measured(relation, std::numeric_limits<double>::quiet_NaN(), message);
  }
}

}  // namespace

std::vector<RelationGroup> wanted_groups(const std::vector<std::string>& only) {
  std::vector<std::string> known;
  for (const RelationGroup& group : relation_groups()) known.emplace_back(group.name);
  for (const std::string& name : only) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw UsageError("--only: '" + printable(name) + "' is no group of relations; " +
                     key_remedy(name, known));
  }
  std::vector<RelationGroup> groups;
  for (const RelationGroup& group : relation_groups()) {
    if (only.empty() || std::find(only.begin(), only.end(), group.name) != only.end())
      groups.push_back(group);
  }
  return groups;
}

std::optional<std::vector<RelationResult>> measure_groups(std::span<const RelationGroup> groups,
                                                          const RelationCase& subject,
                                                          const StabilityEars& ears,
                                                          const std::function<bool()>& stopped) {
  RelationLog log([&](const RelationResult& result) {
    ears.relation_ends(result);
    if (stopped()) throw StopAsked{};
  });
  try {
    for (const RelationGroup& group : groups) {
      if (stopped()) return std::nullopt;
      ears.group_begins(group);
      log.begin_group(group.name);
      measure_group(group, subject, log);
    }
  } catch (const StopAsked&) {
    return std::nullopt;
  }
  return log.take();
}

}  // namespace herr
