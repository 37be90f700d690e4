// The references of one instant, made when they are first asked for. Before: reference_spec. After:
// measure_setting takes errors against them.
#pragma once

#include <functional>
#include <list>
#include <string>
#include <vector>

#include "server/study/reference/reference_cache.h"
#include "server/study/reference/reference_picture.h"

namespace herr {

// Not thread-safe. `instant` must outlive it.
class References {
 public:
  struct Context {
    std::string subject;  // what the pictures are of, beside frame and settings: inputs, instruction set
    ReferenceCache* cache = nullptr;
    ParallelFor parallel_for;
    std::function<bool()> out_of_time;  // of passes over pixels, beyond the first
    // render_halves(): asked after the first pass; true: it must be enough. Empty: it need not.
    std::function<bool(double so_far_s, double pass_s)> one_pass;
    std::function<bool()> stopped;  // what is cut short by this is not kept on disk
    // Rows were measured against the one of this name: another one must not take its place.
    std::function<bool(const std::string& name)> is_known;
    std::function<void(const std::string&)> warn;  // of a file that is damaged and made again
    std::function<void(const std::string&)> tell;  // what is being made
  };
  References(const FrameInstant& instant, Context context)
      : instant_(instant), context_(std::move(context)) {}

  // Valid until the next call. Those over pixels are kept in memory and on disk, those of many seeds the last
  // two in memory. `improve`: one on disk that was left with too large an error is made again, unless there
  // is no time for more passes than it has. Throws InputError where one that is known is not on disk as it
  // was.
  const ReferencePicture& get(const ReferenceSpec& spec, bool improve = false);

  // What was made or found, without pictures, in order.
  const std::vector<ReferencePicture>& made() const { return made_; }
  double seconds() const { return seconds_; }  // that making them took, earlier runs included

 private:
  ReferencePicture make(const ReferenceSpec& spec, bool improve);

  const FrameInstant& instant_;
  Context context_;
  std::list<ReferencePicture> kept_;
  std::vector<ReferencePicture> made_;
  double seconds_ = 0;
};

}  // namespace herr
