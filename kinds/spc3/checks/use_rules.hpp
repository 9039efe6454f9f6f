#pragma once
// Which registers, cells and bytes the user touches, and when. Blocks of the master: blocks.hpp.
#include "kinds/spc3/checks/check.hpp"
#include "kinds/spc3/checks/seen_chip.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::spc3_checks {

class UseRules {
 public:
  /// Both must outlive it.
  UseRules(checks::Recorder& recorder, const SeenChip& chip) : recorder_(recorder), chip_(chip) {}

  /// Before the chip has taken it. `may_resize`: in WAIT_CFG, a configuration awaits its answer.
  void accessed(const RegisterAccess& access, bool may_resize);

 private:
  void organisation(const RegisterAccess& access, bool may_resize);
  void data(const RegisterAccess& access, bool inputs);
  void diagnosis(const RegisterAccess& access);
  bool may_write(Address address, bool may_resize) const;

  checks::Recorder& recorder_;
  const SeenChip& chip_;
};

}  // namespace dsdpv1::spc3_checks
