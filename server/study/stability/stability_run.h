// Asks the groups of relations of a case, one after another. Before: stability_case. After: StabilityRecord.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/study/relations/relation.h"

namespace herr {

// The groups of these names in the list's order; all for none. Throws UsageError that names the nearest.
std::vector<RelationGroup> wanted_groups(const std::vector<std::string>& only);

// Who hears of what is measured.
struct StabilityEars {
  std::function<void(const RelationGroup&)> group_begins;
  std::function<void(const RelationResult&)> relation_ends;
};

// Empty: a signal asked for the end; relations are not cut within. A group that throws is a relation that
// could not be measured, with the message, and the next group goes on; but what another try may mend (no
// memory, no room on the disk) is thrown on.
std::optional<std::vector<RelationResult>> measure_groups(std::span<const RelationGroup> groups,
                                                          const RelationCase& subject,
                                                          const StabilityEars& ears,
                                                          const std::function<bool()>& stopped);

}  // namespace herr
