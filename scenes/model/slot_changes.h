// Which instances of a scene changed, and since when. Every change has a number, and each slot of
// Scene::instances remembers that of its last one: whoever knows up to which number it has looked gets the
// slots that changed since, in time that grows with these alone.
// Before: changes/world.h notes each change. After: the renderer looks only at what it is told of.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace herr {

struct ChangedSlot {
  std::uint32_t slot = 0;
  bool renewed = false;  // it came, went, or has another mesh or material; false: it only stands elsewhere
};

// Not thread-safe. Memory grows with the number of slots, not of changes.
class SlotChanges {
 public:
  using Number = std::uint64_t;

  // `latest`: the number of the last change so far, of which nothing is known.
  explicit SlotChanges(Number latest = 0) : latest_(latest) {}

  // Slots from now on; never fewer than before.
  void resize(std::size_t slots) { slots_.resize(slots); }
  // Slot < size: it stands elsewhere; it came, went, or has another mesh or material.
  void note_moved(std::uint32_t slot) { touch(slot); }
  void note_renewed(std::uint32_t slot) {
    touch(slot);
    slots_[slot].renewed = latest_;
  }
  // Lights shine otherwise than by their paths.
  void note_relit() { relit_ = ++latest_; }

  Number latest() const { return latest_; }
  bool relit_since(Number seen) const { return relit_ > seen; }
  // The slots that changed after change number `seen`, ascending, in place of what `out` held.
  void since(Number seen, std::vector<ChangedSlot>& out) const {
    out.clear();
    for (std::uint32_t slot = newest_; slot != kNone && slots_[slot].changed > seen;
         slot = slots_[slot].older)
      out.push_back({slot, slots_[slot].renewed > seen});
    std::sort(out.begin(), out.end(), [](ChangedSlot a, ChangedSlot b) { return a.slot < b.slot; });
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;
  // One entry of a list of all slots that ever changed, the last one first.
  struct Slot {
    Number changed = 0, renewed = 0;
    std::uint32_t newer = kNone, older = kNone;
  };

  void touch(std::uint32_t index) {
    Slot& slot = slots_[index];
    slot.changed = ++latest_;
    if (newest_ == index) return;
    if (slot.newer != kNone) slots_[slot.newer].older = slot.older;
    if (slot.older != kNone) slots_[slot.older].newer = slot.newer;
    slot.newer = kNone;
    slot.older = newest_;
    if (newest_ != kNone) slots_[newest_].newer = index;
    newest_ = index;
  }

  std::vector<Slot> slots_;
  std::uint32_t newest_ = kNone;
  Number latest_ = 0, relit_ = 0;
};

}  // namespace herr
