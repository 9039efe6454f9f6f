#pragma once
// An input used with tick resolution: events at a tick use levels as they were strictly before it.
#include "model/profibus/time.hpp"

namespace dsdpv1 {

class Wire {
 public:
  explicit Wire(bool level) : level_(level), before_(level) {}

  /// `at`: not before an earlier call's tick. Several changes at one tick count as one.
  void set(profibus::Tick at, bool level) {
    if (at != changed_) {
      before_ = level_;
      changed_before_ = changed_;
      changed_ = at;
    }
    level_ = level;
  }
  bool level() const { return level_; }
  /// The level strictly before `at`, which is not before the last change, and the tick of its last change.
  bool before(profibus::Tick at) const { return at == changed_ ? before_ : level_; }
  profibus::Tick changed_before(profibus::Tick at) const { return at == changed_ ? changed_before_ : changed_; }
  bool changes(profibus::Tick at) const { return at == changed_; }

  static constexpr profibus::Tick kLongAgo = -1'000'000'000;

  template <class Archive>
  void store(Archive& archive) {
    auto& [level, before, changed, changed_before] = *this;
    archive(level, before);
    archive.ticks(changed, changed_before);
  }

 private:
  bool level_, before_;
  profibus::Tick changed_ = kLongAgo, changed_before_ = kLongAgo;
};

}  // namespace dsdpv1
