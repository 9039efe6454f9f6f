#pragma once
// Two flip-flops at an asynchronous input (ruling P9): the logic uses at edge m+2 the level sampled at rising edge m.
#include <array>

#include "model/profibus/time.hpp"

namespace dsdpv1::profibus {

class Synchroniser {
 public:
  explicit Synchroniser(bool level) : level_(level), input_(level) {}

  /// The input changes at `at`; pulses that no rising edge samples are lost.
  void set(Tick at, bool level) {
    if (level == input_) return;
    input_ = level;
    const Cycle visible = first_edge_after(at) + 2;
    if (count_ > 0 && slot(count_ - 1).cycle == visible)
      slot(count_ - 1).level = level;
    else
      slot(count_++) = {visible, level};
  }
  /// The edge of `now`. Returns true if the logic's level changes.
  bool eval(Cycle now) {
    const bool before = level_;
    while (count_ > 0 && slot(0).cycle <= now) {
      level_ = slot(0).level;
      first_ = (first_ + 1) % kDepth;
      --count_;
    }
    return level_ != before;
  }
  Cycle next() const { return count_ > 0 ? changes_[first_].cycle : kNever; }
  bool level() const { return level_; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [changes, first, count, level, input] = *this;
    archive(changes, level, input);
    archive.within(0U, kDepth - 1, first);
    archive.within(0U, kDepth, count);
  }

 private:
  static constexpr unsigned kDepth = 4;  // at most the three edges still on their way, and the one being sampled
  struct Change {
    Cycle cycle = 0;
    bool level = false;

    template <class Archive>
    void store(Archive& archive) {
      auto& [at, high] = *this;
      archive.cycles(at);
      archive(high);
    }
  };
  Change& slot(unsigned i) { return changes_[(first_ + i) % kDepth]; }

  std::array<Change, kDepth> changes_{};
  unsigned first_ = 0, count_ = 0;
  bool level_, input_;
};

}  // namespace dsdpv1::profibus
