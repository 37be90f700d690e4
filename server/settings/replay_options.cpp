#include "server/settings/replay_options.h"

namespace herr {

const char* name_of(SamplingMode mode) {
  switch (mode) {
    case SamplingMode::latest:
      return "latest";
    case SamplingMode::predict:
      return "predict";
    case SamplingMode::interpolate:
      return "interpolate";
  }
  return "unknown";
}

}  // namespace herr
