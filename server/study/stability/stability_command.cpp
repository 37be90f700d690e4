#include "server/study/stability/stability_command.h"

#include <algorithm>
#include <string>

#include "server/process/exit_code.h"
#include "server/process/terminal.h"
#include "server/settings/option_checks.h"
#include "server/study/relations/relation.h"
#include "server/study/report/figure_text.h"
#include "server/study/stability/stability_case.h"

namespace herr {
namespace {

void tell(const RelationResult& result) {
  print_message(result.group + ": " + result.relation.name + ": " +
                (result.asked() ? (result.holds() ? "holds, " : "FAILS, ") + figure(result.error) + " of " +
                                      figure(result.relation.bound) + " " + result.relation.unit
                                : "not applicable: " + result.not_applicable) +
                (result.holds() || result.where.empty() ? "" : "; " + result.where) + " (" +
                figure(result.seconds, 2) + " s)");
}

}  // namespace

int run_stability(const StudyOptions& options) {
  check_render_settings(options.render);
  const StabilityCase subject(options);
  RelationLog log(tell);
  for (const RelationGroup& group : relation_groups()) {
    const bool wanted = options.only.empty() ||
                        std::find(options.only.begin(), options.only.end(), group.name) != options.only.end();
    if (!wanted) continue;
    log.begin_group(group.name);
    group.measure(subject.relations(), log);
  }
  const bool holds =
      std::all_of(log.results().begin(), log.results().end(),
                  [](const RelationResult& result) { return result.holds() || !result.counts(); });
  return holds ? kExitDone : kExitRegression;
}

}  // namespace herr
