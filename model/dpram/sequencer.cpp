#include "model/dpram/sequencer.hpp"

#include <algorithm>

namespace dsdpv1::dpram {

void Sequencer::reset() {
  goto_phase(Phase::kOff, profibus::kNever);
  initialised_ = dozing_ = valid_written_ = init_result_due1_ = init_result_due4_ = false;
  offline_written_ = 0;
  status3_written_ = chip_status1_ = chip_status4_ = status2_set_ = status2_clear_ = 0;
  accesses_ = outputs_overwritten_ = 0;
  longest_wait_ = 0;
  told_user_ = effect_ = profibus::kNever;
  crc_item_ = Item::kNone;
}

bool Sequencer::eval(Cycle now) {
  if (!waiting())
    catch_up(now);
  else if (now >= due_ && !user_holds_)
    begin(now);
  return effect_ == now;
}

Cycle Sequencer::next() const {
  if (dozing_) return profibus::kNever;
  if (!waiting()) return visible_;
  return user_holds_ ? profibus::kNever : due_;
}

void Sequencer::catch_up(Cycle until) {
  make_moves(until);
  if (!dozing_ || owns() || due_ > until) return;
  make_up_accesses(until);
  make_moves(until);
}

void Sequencer::make_moves(Cycle until) {
  if (phase_ == Phase::kHeader && index_ == 0 && op_ + kHeaderMoves - 1 <= until) header_at_once();
  while (owns() && op_ <= until) move(op_++);
}

// --- the access ------------------------------------------------------------------------------------------------------

void Sequencer::begin(Cycle now) {
  longest_wait_ = std::max(longest_wait_, now - due_);
  ++accesses_;
  start_ = now;
  op_ = now + 1;
  index_ = 0;
  if (phase_ == Phase::kDue)
    goto_phase(Phase::kStartUp, now + kStartUpMoves + 1);
  else
    goto_phase(Phase::kHeader, now + kQuietAccess);
}

void Sequencer::end(Cycle now) {
  due_ = std::max(start_ + interval_, now + 1);  // H1, H8
  goto_phase(Phase::kIdle, profibus::kNever);
}

void Sequencer::move(Cycle now) {
  switch (phase_) {
    case Phase::kOff:
    case Phase::kDue:
    case Phase::kIdle: return;
    case Phase::kStartUp: return move_start_up(now);
    case Phase::kHeader: return move_header(now);
    case Phase::kChoose: return choose(now);
    case Phase::kRead: return read_byte();
    case Phase::kDecode: return decode(now);
    case Phase::kReadRest: return read_byte();
    case Phase::kCheck: phase_ = Phase::kCommit; return;
    case Phase::kCommit: return commit(now);
    case Phase::kWrite: return write_byte();
    case Phase::kCrcHigh:
    case Phase::kCrcLow: return write_crc();
    case Phase::kFlag: return flag(now);
    case Phase::kStatus2: return write_status2(now);
  }
}

// --- what was read ---------------------------------------------------------------------------------------------------

bool Sequencer::is_possible(Cycle now) const {
  if (op_ == profibus::kNever) return false;
  const bool begun_lately = op_ + kStartUpMoves + 1 > now;
  if (dozing_ && phase_ != Phase::kIdle && phase_ != Phase::kHeader && phase_ != Phase::kChoose) return false;
  return !owns() || ((dozing_ || begun_lately) && is_possible_block());
}

bool Sequencer::is_possible_block() const {
  const bool reads = item_ <= Item::kC2Answer && item_ != Item::kInputClear;
  const bool writes = item_ > Item::kC2Answer && item_ <= Item::kC2Request;
  const int header = area(item_).header;
  const bool whole = image_size_ >= header && image_size_ <= header + area(item_).maximum;
  switch (phase_) {
    case Phase::kHeader: return index_ < kHeaderMoves;
    case Phase::kRead: return reads && image_size_ == header && index_ < image_size_;
    case Phase::kDecode: return reads && image_size_ == header;
    case Phase::kReadRest: return reads && whole && index_ < image_size_ + 2;
    case Phase::kCheck:
    case Phase::kCommit: return reads && (image_size_ == 0 || whole);
    case Phase::kWrite: return writes && index_ < image_size_;
    case Phase::kCrcHigh:
    case Phase::kCrcLow:
    case Phase::kFlag: return writes;
    case Phase::kStatus2: return item_ == Item::kChipStatus2;
    default: return true;
  }
}

}  // namespace dsdpv1::dpram
