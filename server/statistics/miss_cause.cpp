#include "server/statistics/miss_cause.h"

namespace herr {

const char* name_of(MissCause cause) {
  switch (cause) {
    case MissCause::none:
      return "";
    case MissCause::work:
      return "work";
    case MissCause::machine:
      return "machine";
    case MissCause::both:
      return "both";
  }
  return "unknown";
}

MissCause cause_of_miss(const MissFacts& facts) {
  if (!facts.cpu_ms || facts.preemptions.value_or(0) == 0) return MissCause::work;
  const bool kept_off = *facts.cpu_ms < kBusyShare * facts.threads * facts.frame_ms;
  const bool fits = facts.beside_cpu_ms + *facts.cpu_ms / facts.threads <= facts.period_ms;
  if (!kept_off) return MissCause::work;
  return fits ? MissCause::machine : MissCause::both;
}

}  // namespace herr
