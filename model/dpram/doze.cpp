// Simulates accesses without work afterwards, where they are not observed.
#include "model/dpram/sequencer.hpp"

namespace dsdpv1::dpram {

bool Sequencer::may_doze() const {
  return phase_ == Phase::kIdle && !user_holds_ && valid_written_ && nothing_due() &&
         (ram_.read(regs::kUserCommand1) & kUserCommands1) == 0 &&
         (ram_.read(regs::kUserCommand2) & kUserCommands2) == 0;
}

// The last access, of which only a part may lie before `until`, is executed byte by byte.
void Sequencer::make_up_accesses(Cycle until) {
  const Cycle whole = (until - due_) / period();
  accesses_ += static_cast<std::uint64_t>(whole);
  if (whole > 0) ram_.write(regs::kAccessCount, kChipWasHere);
  due_ += whole * period();
  begin(due_);
}

void Sequencer::wake(Cycle now) {
  catch_up(now);
  dozing_ = false;
}

void Sequencer::end_quietly() {
  header_at_once();
  end(op_++);
}

}  // namespace dsdpv1::dpram
