// The clock of a replay.
#pragma once

namespace herr {

// How the frames of a session are laid out in time.
enum class ReplayClock {
  virtual_time,  // one display period of session time for each frame, however long it takes
  realtime,      // session time is wall time: frames that come too late are dropped
  max,           // like virtual_time, but a frame is shown when it is done
};
const char* name_of(ReplayClock clock);

}  // namespace herr
