// The beginning of an access of the chip (ruling H3): it sets the access count B006, then reads the user's commands.
#include "model/dpram/sequencer.hpp"

namespace dsdpv1::dpram {

void Sequencer::move_header(Cycle now) {
  static constexpr std::array<regs::Address, kHeaderMoves> kCells = {regs::kAccessCount,  regs::kUserCommand1,
                                                                     regs::kUserCommand2, regs::kChipCommand1,
                                                                     regs::kChipCommand2, regs::kDpv1Enable};
  const auto index = static_cast<std::size_t>(index_);
  read_header(index_++);
  if (notes_moves_) note(kCells[index], ram_.read(kCells[index]), index == 0);
  if (index_ < kHeaderMoves) return;
  item_ = Item::kInit;
  goto_phase(Phase::kChoose, now + 1);
}

void Sequencer::read_header(int index) {
  switch (index) {
    case 0: ram_.write(regs::kAccessCount, kChipWasHere); return;
    case 1: user_command1_ = ram_.read(regs::kUserCommand1); return;
    case 2: user_command2_ = ram_.read(regs::kUserCommand2); return;
    case 3: chip_command1_ = ram_.read(regs::kChipCommand1); return;
    case 4: chip_command2_ = ram_.read(regs::kChipCommand2); return;
    default: dpv1_ = ram_.read(regs::kDpv1Enable); return;
  }
}

// Nothing is noted, because no observer looks meanwhile.
void Sequencer::header_at_once() {
  for (int index = 0; index < kHeaderMoves; ++index) read_header(index);
  op_ += kHeaderMoves;
  item_ = Item::kInit;
  goto_phase(Phase::kChoose, op_);
}

}  // namespace dsdpv1::dpram
