#include "server/settings/replay_clock.h"

namespace herr {

const char* name_of(ReplayClock clock) {
  switch (clock) {
    case ReplayClock::virtual_time:
      return "virtual";
    case ReplayClock::realtime:
      return "realtime";
    case ReplayClock::max:
      return "max";
  }
  return "unknown";
}

}  // namespace herr
