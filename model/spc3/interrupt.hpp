#pragma once
// The interrupt controller (M 4.3; A10 to A15): requests, mask, and the latch of X/INT, which EOI alone resets.
#include <algorithm>

#include "model/profibus/time.hpp"
#include "registers/spc3_regs.hpp"

namespace dsdpv1::spc3 {

using profibus::Cycle;
using profibus::kNever;

class Interrupt {
 public:
  /// `delay`: cycles from IR to the latch (A40).
  explicit Interrupt(Cycle delay) : delay_(delay) {}

  void reset() {
    irr_ = 0;
    imr_ = 0xFFFF;
    latch_ = false;
    since_ = kNever;
    inactive_until_ = 0;
  }

  /// The chip's events. An event and its acknowledgement in one clock: the event stays, since accesses come before.
  void raise(std::uint16_t events) { irr_ = static_cast<std::uint16_t>(irr_ | events); }
  void clear(std::uint16_t events) { irr_ = static_cast<std::uint16_t>(irr_ & ~events); }
  /// The user's IAR: the two that only a verdict clears stay (A15).
  void acknowledge(std::uint16_t events) {
    clear(static_cast<std::uint16_t>(events & ~(regs::kEventNewCfg | regs::kEventNewPrm)));
  }
  /// Bytes of IRR and IMR, as the user writes them (A10, A11).
  void set_irr(bool high, std::uint8_t value) { irr_ = with_byte(irr_, high, value); }
  void set_imr(bool high, std::uint8_t value) { imr_ = with_byte(imr_, high, value); }
  /// A13: the output is inactive from `now` on, for `gap` at least; nothing without INT.
  void end(Cycle now, Cycle gap) {
    if (!latch_) return;
    latch_ = false;
    inactive_until_ = now + gap;
  }

  std::uint16_t irr() const { return irr_; }
  std::uint16_t ir() const { return static_cast<std::uint16_t>(irr_ & ~imr_); }
  bool latch() const { return latch_; }

  /// The edge of `now`, after all that changed requests and mask.
  void eval(Cycle now) {
    if (ir() == 0)
      since_ = kNever;
    else if (since_ == kNever)
      since_ = now;
    if (now >= next()) latch_ = true;
  }
  Cycle next() const {
    if (latch_ || since_ == kNever) return kNever;
    return std::max(since_ + delay_, inactive_until_);
  }

  template <class Archive>
  void store(Archive& archive) {
    auto& [delay, irr, imr, latch, since, inactive_until] = *this;
    archive.given(delay);
    archive(irr, imr, latch);
    archive.cycles(since, inactive_until);
  }

 private:
  static std::uint16_t with_byte(std::uint16_t word, bool high, std::uint8_t value) {
    return static_cast<std::uint16_t>(high ? (word & 0x00FF) | value << 8 : (word & 0xFF00) | value);
  }

  const Cycle delay_;
  std::uint16_t irr_ = 0, imr_ = 0xFFFF;
  bool latch_ = false;
  Cycle since_ = kNever;      // IR is not 0
  Cycle inactive_until_ = 0;  // after EOI
};

}  // namespace dsdpv1::spc3
