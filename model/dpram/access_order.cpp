// The work that an access finds, and its order (ruling H4).
#include "model/dpram/sequencer.hpp"

namespace dsdpv1::dpram {

void Sequencer::choose(Cycle now) {
  const unsigned left = due_items(now) & ~(mask(item_) - 1);
  if (left == 0) return end(now);
  item_ = static_cast<Item>(__builtin_ctz(left));
  start(item_, now);
}

// Work for an access that chooses at `now`, as far as it has read the user's commands.
unsigned Sequencer::due_items(Cycle now) const { return due_commands() | due_mail(now) | due_status(); }

// Most accesses find no command.
unsigned Sequencer::due_commands() const {
  if ((user_command1_ & kUserCommands1) == 0 && (user_command2_ & kUserCommands2) == 0) return 0;
  const auto command1 = [this](Item item, unsigned flag) { return when(item, (user_command1_ & flag) != 0); };
  const auto command2 = [this](Item item, unsigned flag) { return when(item, (user_command2_ & flag) != 0); };
  return command1(Item::kInit, regs::kUserCommand1Init) | command1(Item::kPrmVerdict, regs::kUserCommand1PrmVerdict) |
         command1(Item::kCfgVerdict, regs::kUserCommand1CfgVerdict) |
         command2(Item::kInputClear, regs::kUserCommand2InputClear) | command1(Item::kInput, regs::kUserCommand1Input) |
         command1(Item::kDiag, regs::kUserCommand1Diag) | command2(Item::kC1Answer, regs::kUserCommand2C1) |
         command2(Item::kC2Answer, regs::kUserCommand2C2);
}

unsigned Sequencer::due_mail(Cycle now) const {
  const profibus::UserMail& mail = user_.mail();
  return when(Item::kPrm, mail.prm.due.before(now)) | when(Item::kCfg, mail.cfg.due.before(now)) |
         when(Item::kOutput, mail.output.due.before(now)) | when(Item::kC1Request, mail.c1.due.before(now)) |
         when(Item::kC2Request, mail.c2.due.before(now));
}

unsigned Sequencer::due_status() const {
  const auto offline = static_cast<unsigned>(user_.mail().state.exchanges_left ^ offline_written_);
  return when(Item::kValidFlag, !valid_written_ && start_ >= origin_ + ready_cycles_) |
         when(Item::kOfflineHigh, offline > 0xFF) | when(Item::kOfflineLow, (offline & 0xFF) != 0) |
         when(Item::kChipStatus1, init_result_due1_) | when(Item::kChipStatus2, (status2_set_ | status2_clear_) != 0) |
         when(Item::kChipStatus3, status3() != status3_written_) | when(Item::kChipStatus4, init_result_due4_);
}

void Sequencer::start(Item item, Cycle now) {
  if (item == Item::kInputClear) return clear_input_error(now);
  if (item <= Item::kC2Answer) return start_read(now, area(item));
  if (item <= Item::kC2Request) return start_write(now, item);
  status_byte(item, now);
}

}  // namespace dsdpv1::dpram
