// Shared objects whose storage comes back: a thread that publishes large things many times a second
// allocates them a few times in all. Whoever drops the last reference gives the object back.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace herr {

// One thread takes; objects may outlive it, and come back from any thread.
template <typename T>
class Recycler {
 public:
  // An object that nobody else has, with the contents that its last user left.
  std::shared_ptr<T> take() {
    std::unique_ptr<T> object;
    {
      const std::lock_guard lock(spare_->mutex);
      if (!spare_->objects.empty()) {
        object = std::move(spare_->objects.back());
        spare_->objects.pop_back();
      }
    }
    if (!object) {
      object = std::make_unique<T>();
      ++made_;
    }
    return {object.release(), [spare = spare_](T* used) {
              std::unique_ptr<T> owned(used);
              const std::lock_guard lock(spare->mutex);
              spare->objects.push_back(std::move(owned));
            }};
  }

  // Objects that exist, with whoever has them or spare. Of the thread that takes.
  int made() const { return made_; }

 private:
  struct Spare {
    std::mutex mutex;
    std::vector<std::unique_ptr<T>> objects;
  };
  std::shared_ptr<Spare> spare_ = std::make_shared<Spare>();
  int made_ = 0;
};

}  // namespace herr
