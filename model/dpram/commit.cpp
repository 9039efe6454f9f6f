// The effect of the user's blocks once an access of the chip has read them (rulings D5, D7, D10 to D14, D16, D17, H7).
#include "model/dpram/crc16.hpp"
#include "model/dpram/init_data.hpp"
#include "model/dpram/reasons.hpp"
#include "model/dpram/sequencer.hpp"

namespace dsdpv1::dpram {

void Sequencer::commit(Cycle now) {
  const bool acyclic = acyclic_answer(item_);
  std::uint8_t& command = acyclic ? user_command2_ : user_command1_;
  command = static_cast<std::uint8_t>(command & ~area(item_).flag);
  put(acyclic ? regs::kUserCommand2 : regs::kUserCommand1, command);
  goto_phase(Phase::kChoose, now + 1);
  effect_ = now;
  const bool too_long = image_size_ == 0;
  switch (item_) {
    case Item::kInit: too_long ? refuse_length(now) : commit_init(now); break;
    case Item::kInput: too_long ? refuse_length(now) : commit_input(now); break;
    case Item::kDiag: too_long ? refuse_length(now) : commit_diag(now); break;
    case Item::kC1Answer:
    case Item::kC2Answer: too_long ? refuse_length(now) : commit_acyclic(now); break;
    default: commit_verdict(now); break;
  }
  next_item();
}

bool Sequencer::crc_right(Cycle now, profibus::Reason reason, std::uint8_t error_bit) {
  const auto* stored = &image_[static_cast<std::size_t>(image_size_)];
  const unsigned found = static_cast<unsigned>(stored[0]) << 8 | stored[1];
  const unsigned computed = crc16(image_.data(), image_size_);
  const bool right = found == computed || !judges_crc_;
  crc_item_ = item_;
  crc_right_ = right;
  if (right && !(item_ == Item::kInput && input_history())) status2_clear_ |= error_bit;
  if (!right) status2_set_ |= error_bit;
  if (!right) log_.at_cycle(now, reason, found, computed);
  return right;
}

bool Sequencer::input_history() const { return (user_command2_ & regs::kUserCommand2InputHistory) != 0; }

// Requested by the user with B011.7; without history there is nothing to clear.
void Sequencer::clear_input_error(Cycle now) {
  user_command2_ = static_cast<std::uint8_t>(user_command2_ & ~regs::kUserCommand2InputClear);
  put(regs::kUserCommand2, user_command2_);
  if (input_history()) status2_clear_ |= regs::kChipStatus2InputCrc;
  next_item();
  goto_phase(Phase::kChoose, now + 1);
}

void Sequencer::refuse_length(Cycle now) {
  const std::uint8_t* header = image_.data();
  switch (item_) {
    case Item::kInit:
      log_.at_cycle(now, Reason::kInitLength, header[0], regs::kInitCfg - regs::kInit - 1);
      return init_result(false);
    case Item::kInput:
      return log_.at_cycle(now, profibus::Reason::kInputLength, header[0], static_cast<unsigned>(user_.input_size()));
    case Item::kDiag: return log_.at_cycle(now, profibus::Reason::kDiagLength, header[1], regs::kDiagDataSize);
    default: return log_.at_cycle(now, Reason::kAcyclicLength, item_ == Item::kC1Answer ? 1 : 2, header[3]);
  }
}

void Sequencer::commit_init(Cycle now) {
  init_result_due1_ = true;
  chip_status1_ = 0;
  if (!crc_right(now, Reason::kInitCrc, regs::kChipStatus2InitCrc)) return;
  profibus::SlaveConfig config;
  const bool good = parse_init(image_.data(), image_size_, now, log_, config);
  init_result(good);
  if (!good) return;
  config.dpv1 = dpv1_ == regs::kDpv1EnableOn;  // D17
  log_.at_cycle(now, Reason::kInitialised, config.address, config.ident, config.dpv1);
  user_.initialise(now, config);
  initialised_ = true;
}

void Sequencer::init_result(bool good) {
  chip_status1_ = good ? regs::kChipStatus1Initialised : std::uint8_t{0};
  chip_status4_ = good ? std::uint8_t{0} : regs::kChipStatus4InitLimit;
  init_result_due1_ = init_result_due4_ = true;
}

void Sequencer::commit_input(Cycle now) {
  if (offline()) return log_.at_cycle(now, Reason::kBeforeInit, area(item_).flag, regs::kUserCommand1);
  if (!crc_right(now, Reason::kInputCrc, regs::kChipStatus2InputCrc)) return;
  user_.new_inputs(now, &image_[1], image_size_ - 1);
}

void Sequencer::commit_diag(Cycle now) {
  if (offline()) return log_.at_cycle(now, Reason::kBeforeInit, area(item_).flag, regs::kUserCommand1);
  if (!crc_right(now, Reason::kDiagCrc, regs::kChipStatus2DiagCrc)) return;
  user_.new_diagnosis(now, image_[0], &image_[2], image_size_ - 2);
}

void Sequencer::commit_acyclic(Cycle now) {
  const bool c1 = item_ == Item::kC1Answer;
  if (offline()) return log_.at_cycle(now, Reason::kBeforeInit, area(item_).flag, regs::kUserCommand2);
  const std::uint8_t error_bit = c1 ? regs::kChipStatus2C1Crc : regs::kChipStatus2C2Crc;
  if (!crc_right(now, c1 ? Reason::kC1Crc : Reason::kC2Crc, error_bit)) return;
  if (c1)
    user_.c1_answer(now, image_.data(), image_size_);
  else
    user_.c2_answer(now, image_.data(), image_size_);
}

void Sequencer::commit_verdict(Cycle now) {
  const std::uint8_t verdict = image_[0];  // B00C
  if (item_ == Item::kPrmVerdict)
    user_.prm_verdict(now, (verdict & regs::kUserStatus1PrmWrong) == 0);
  else
    user_.cfg_verdict(now, (verdict & regs::kUserStatus1CfgWrong) == 0);
}

}  // namespace dsdpv1::dpram
