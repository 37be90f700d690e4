// What the pass over a whole session meets, row by row, and what is wrong with it. Who listens decides what a
// fault means: replay stops at the first one, inspect writes all of them down.
// Before: visit_session (session_check.h). After: Session::open, inspect_session.
#pragma once

#include <cstddef>

#include "sessions/files/input_error.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

enum class FaultKind {
  row,      // one row cannot be used; the stream goes on without it
  image,    // likewise a camera row, or the picture that it names
  stream,   // a stream cannot be used as a whole
  cut_off,  // the file ends within its last line, which is dropped
  gap,      // legal: samples are more than a second apart
  remark,   // legal, but not what one would expect
  stated    // legal, and the header says so itself
};

class SessionVisitor {
 public:
  virtual ~SessionVisitor() = default;
  // May throw to end the pass.
  virtual void fault(FaultKind kind, const InputError& error) = 0;
  // Good rows in the order of the file; `rows` stands at the row.
  virtual void pose(const PoseRow& /*row*/, const CsvRows& /*rows*/) {}
  // The poses are read first; nothing more will come of them.
  virtual void poses_done() {}
  virtual void gaze(const GazeRow& /*row*/, const CsvRows& /*rows*/) {}
  virtual void camera(std::size_t /*index*/, const CameraRow& /*row*/, const CsvRows& /*rows*/) {}
};

}  // namespace herr
