// Cells that show the user a state: the valid flag, the offline count, chip status 1 to 4 (rulings D1, D5, D13).
#include "model/dpram/reasons.hpp"
#include "model/dpram/sequencer.hpp"

namespace dsdpv1::dpram {

static_assert(profibus::kBaudUnknown.code() == regs::kBaudSearching && profibus::kBaudCount == regs::kBaudRate9k6 + 1);

void Sequencer::status_byte(Item item, Cycle now) {
  move_status(item, now);
  if (item == Item::kChipStatus2) return goto_phase(Phase::kStatus2, now + 1);
  next_item();
  goto_phase(Phase::kChoose, now + 1);
}

void Sequencer::move_status(Item item, Cycle now) {
  const std::uint16_t count = user_.mail().state.exchanges_left;
  switch (item) {
    case Item::kValidFlag:
      put(regs::kValidFlag, regs::kValidFlagValid);
      valid_written_ = true;
      log_.at_cycle(now, Reason::kReadyFlag);
      return;
    case Item::kOfflineHigh:
      put(regs::kOfflineCount, static_cast<std::uint8_t>(count >> 8));
      offline_written_ = static_cast<std::uint16_t>((count & 0xFF00) | (offline_written_ & 0xFF));
      return;
    case Item::kOfflineLow:
      put(regs::kOfflineCount + 1, static_cast<std::uint8_t>(count & 0xFF));
      offline_written_ = static_cast<std::uint16_t>((offline_written_ & 0xFF00) | (count & 0xFF));
      return;
    case Item::kChipStatus1:
      put(regs::kChipStatus1, chip_status1_);
      init_result_due1_ = false;
      return;
    case Item::kChipStatus2: status2_read_ = get(regs::kChipStatus2); return;
    case Item::kChipStatus3:
      status3_written_ = status3();
      put(regs::kChipStatus3, status3_written_);
      return;
    default:
      put(regs::kChipStatus4, chip_status4_);
      init_result_due4_ = false;
      return;
  }
}

std::uint8_t Sequencer::status3() const {
  const int state = static_cast<int>(user_.mail().state.state);
  return static_cast<std::uint8_t>(user_.mail().baud.index.code() << regs::kChipStatus3BaudRateShift |
                                   state << regs::kChipStatus3DpStateShift);
}

// The second cycle of B00B.
void Sequencer::write_status2(Cycle now) {
  put(regs::kChipStatus2, static_cast<std::uint8_t>((status2_read_ & ~status2_clear_) | status2_set_));
  status2_set_ = status2_clear_ = 0;
  next_item();
  goto_phase(Phase::kChoose, now + 1);
}

}  // namespace dsdpv1::dpram
