#pragma once
// IRR, IAR, IMR, EOI and X/INT (4.3).
#include "kinds/spc3/checks/check.hpp"
#include "kinds/spc3/checks/seen_chip.hpp"
#include "tb/chip/checks/duty.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::spc3_checks {

class InterruptRules {
 public:
  /// Both must outlive it.
  InterruptRules(checks::Recorder& recorder, const SeenChip& chip) : recorder_(recorder), chip_(chip) {}

  void reset();
  void x_int(Tick at, bool level);
  void accessed(const RegisterAccess& access);
  void pass(Tick now);

  /// DX_OUT would have raised X/INT, which is inactive: no outputs wait.
  bool shows_no_outputs() const { return (imr_ & regs::kEventDxOut) == 0 && !eoi_.since(); }

 private:
  void written(const RegisterAccess& access);
  void clear(const RegisterAccess& access, std::uint16_t events);
  void mask(const RegisterAccess& access, std::uint16_t half, std::uint16_t bits);
  void end(Tick at);
  void idle(Tick at);

  checks::Recorder& recorder_;
  const SeenChip& chip_;
  std::uint16_t imr_ = regs::kImrReset;
  std::uint16_t seen_ = 0;  ///< in IRR or IR, not cleared since
  Tick idle_ = 0;           ///< writes that do nothing
  checks::Duty eoi_;        ///< from X/INT's begin
};

}  // namespace dsdpv1::spc3_checks
