#pragma once
// Changes of pins on their way to the caller: reported at once, or kept until they are taken.
#include <algorithm>
#include <cstddef>
#include <new>
#include <vector>

#include "capi/clock.hpp"
#include "dsdpv1/types.h"

namespace dsdpv1::capi {

class Changes {
 public:
  /// `clock` of the object that reports them.
  explicit Changes(Clock& clock) : clock_(clock) {}
  /// `fn` NULL: changes are kept.
  void tell(dpsim_change_fn fn, void* user) {
    fn_ = fn;
    user_ = user;
  }
  void add(const dpsim_change& change) noexcept {
    if (fn_ == nullptr) return keep(change);
    const Callback inside(clock_);
    fn_(user_, &change);
  }
  /// True if they are reported, not kept.
  bool are_told() const { return fn_ != nullptr; }
  /// Reports one, in a call that is Running.
  void tell_running(const dpsim_change& change) { fn_(user_, &change); }
  /// Moves the oldest, at most `capacity`, to `changes`.
  std::size_t take(dpsim_change* changes, std::size_t capacity) {
    const std::size_t count = std::min(capacity, kept_.size() - taken_);
    std::copy_n(kept_.begin() + static_cast<std::ptrdiff_t>(taken_), count, changes);
    taken_ += count;
    if (taken_ >= kept_.size() - taken_) forget_taken();
    return count;
  }
  /// Drops kept changes, whose time no longer applies.
  void forget() {
    kept_.clear();
    taken_ = 0;
    lost_ = false;
  }
  /// After a call that added changes: throws std::bad_alloc if one could not be kept.
  void check() {
    if (!lost_) return;
    lost_ = false;
    throw std::bad_alloc();
  }

 private:
  // Called from inside the core, through which no exception may pass.
  void keep(const dpsim_change& change) noexcept {
    try {
      kept_.push_back(change);
    } catch (...) {
      lost_ = true;
    }
  }

  void forget_taken() {
    kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(taken_));
    taken_ = 0;
  }

  Clock& clock_;
  dpsim_change_fn fn_ = nullptr;
  void* user_ = nullptr;
  std::vector<dpsim_change> kept_;
  std::size_t taken_ = 0;  ///< of `kept_`, from its front
  bool lost_ = false;
};

/// The body of the functions ..._read_changes.
void read_changes(Changes& from, dpsim_change* changes, std::size_t capacity, std::size_t* count);

}  // namespace dsdpv1::capi
