#include "sessions/format/pose.h"

namespace herr {

const char* name_of(SampleSource source) {
  switch (source) {
    case SampleSource::exact:
      return "exact";
    case SampleSource::held:
      return "held";
    case SampleSource::interpolated:
      return "interpolated";
    case SampleSource::predicted:
      return "predicted";
    case SampleSource::gliding:
      return "gliding";
    case SampleSource::centred:
      return "centred";
  }
  return "unknown";
}

}  // namespace herr
