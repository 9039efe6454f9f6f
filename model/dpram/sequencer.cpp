#include "model/dpram/sequencer.hpp"

#include <algorithm>

#include "model/dpram/crc16.hpp"
#include "model/dpram/reasons.hpp"

namespace dsdpv1::dpram {
namespace {

constexpr std::uint8_t kVersion[] = {regs::kVersionReset, regs::kVersionYearReset, regs::kVersionMonthReset,
                                     regs::kVersionDayReset};
constexpr std::uint8_t kChipWasHere = 1;  // B006
// All that the user may ask for with B010 and B011.
constexpr std::uint8_t kUserCommands1 = regs::kUserCommand1Init | regs::kUserCommand1PrmVerdict |
                                        regs::kUserCommand1CfgVerdict | regs::kUserCommand1Input |
                                        regs::kUserCommand1Diag;
constexpr std::uint8_t kUserCommands2 = regs::kUserCommand2InputClear | regs::kUserCommand2C1 | regs::kUserCommand2C2;

// An acyclic answer is as long as its length byte says only when it carries data (V14).
bool carries_data(std::uint8_t function) {
  return function == profibus::dpv1::kRead || function == profibus::dpv1::kTransport;
}

}  // namespace

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

void Sequencer::start_up(Cycle now) {
  origin_ = due_ = now;
  phase_ = Phase::kDue;
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

// --- dozing ----------------------------------------------------------------------------------------------------------

bool Sequencer::may_doze() const {
  return phase_ == Phase::kIdle && !user_holds_ && valid_written_ && nothing_due() &&
         (ram_.read(regs::kUserCommand1) & kUserCommands1) == 0 &&
         (ram_.read(regs::kUserCommand2) & kUserCommands2) == 0;
}

// The last one, of which `until` may see only a part, is carried out byte by byte.
void Sequencer::make_up_accesses(Cycle until) {
  const Cycle period = std::max(interval_, kQuietAccess + 1);
  const Cycle whole = (until - due_) / period;
  accesses_ += static_cast<std::uint64_t>(whole);
  if (whole > 0) ram_.write(regs::kAccessCount, kChipWasHere);
  due_ += whole * period;
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
    case Phase::kWrite:
      put(static_cast<regs::Address>(area(item_).base + index_), image_[static_cast<std::size_t>(index_)]);
      if (++index_ == image_size_) phase_ = Phase::kCrcHigh;
      return;
    case Phase::kCrcHigh:
      put(area(item_).crc, static_cast<std::uint8_t>(image_crc_ >> 8));
      phase_ = Phase::kCrcLow;
      return;
    case Phase::kCrcLow:
      put(static_cast<regs::Address>(area(item_).crc + 1), static_cast<std::uint8_t>(image_crc_ & 0xFF));
      phase_ = Phase::kFlag;
      return;
    case Phase::kFlag: return flag(now);
    case Phase::kStatus2:
      put(regs::kChipStatus2, static_cast<std::uint8_t>((status2_read_ & ~status2_clear_) | status2_set_));
      status2_set_ = status2_clear_ = 0;
      next_item();
      return goto_phase(Phase::kChoose, now + 1);
  }
}

void Sequencer::move_start_up(Cycle now) {
  const int move = index_++;
  if (move < regs::kDpramSize) {
    put(static_cast<regs::Address>(move), 0);
  } else if (move < regs::kDpramSize + kVersionBytes) {
    const int i = move - regs::kDpramSize;
    put(static_cast<regs::Address>(regs::kVersion + i), kVersion[i]);
  } else if (move < kStartUpMoves) {
    put(regs::kAccessCount, kChipWasHere);
  } else {
    end(now);
  }
}

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

// Nobody has looked meanwhile, so nothing is noted.
void Sequencer::header_at_once() {
  for (int index = 0; index < kHeaderMoves; ++index) read_header(index);
  op_ += kHeaderMoves;
  item_ = Item::kInit;
  goto_phase(Phase::kChoose, op_);
}

// --- choosing --------------------------------------------------------------------------------------------------------

void Sequencer::choose(Cycle now) {
  const unsigned left = due_items(now) & ~(mask(item_) - 1);
  if (left == 0) return end(now);
  item_ = static_cast<Item>(__builtin_ctz(left));
  start(item_, now);
}

// What an access that chooses at `now` finds to do, as far as it has read the user's commands.
unsigned Sequencer::due_items(Cycle now) const { return due_commands() | due_mail(now) | due_status(); }

// Most accesses find none of them.
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

const Sequencer::Area& Sequencer::area(Item item) {
  static constexpr Area kInit = {regs::kInit, regs::kInitCrc, 1, regs::kInitSize - 1, regs::kUserCommand1Init};
  static constexpr Area kInput = {regs::kInput, regs::kInputCrc, 1, regs::kInputDataSize, regs::kUserCommand1Input};
  static constexpr Area kDiag = {regs::kDiag, regs::kDiagCrc, 2, regs::kDiagDataSize, regs::kUserCommand1Diag};
  static constexpr Area kPrmVerdict = {regs::kUserStatus1, 0, 1, 0, regs::kUserCommand1PrmVerdict};
  static constexpr Area kCfgVerdict = {regs::kUserStatus1, 0, 1, 0, regs::kUserCommand1CfgVerdict};
  static constexpr Area kPrm = {regs::kPrm, regs::kPrmCrc, 1, regs::kPrmDataSize, regs::kChipCommand1Prm};
  static constexpr Area kCfg = {regs::kCfg, regs::kCfgCrc, 3, regs::kCfgDataSize, regs::kChipCommand1Cfg};
  static constexpr Area kOutput = {regs::kOutput, regs::kOutputCrc, 1, regs::kOutputDataSize,
                                   regs::kChipCommand1Output};
  static constexpr Area kC1Answer = {regs::kC1, regs::kC1Crc, 4, regs::kC1DataSize, regs::kUserCommand2C1};
  static constexpr Area kC2Answer = {regs::kC2, regs::kC2Crc, 4, regs::kC2DataSize, regs::kUserCommand2C2};
  static constexpr Area kC1Request = {regs::kC1, regs::kC1Crc, 4, regs::kC1DataSize, regs::kChipCommand2C1};
  static constexpr Area kC2Request = {regs::kC2, regs::kC2Crc, 4, regs::kC2DataSize, regs::kChipCommand2C2};
  switch (item) {
    case Item::kInit: return kInit;
    case Item::kPrmVerdict: return kPrmVerdict;
    case Item::kCfgVerdict: return kCfgVerdict;
    case Item::kInput: return kInput;
    case Item::kDiag: return kDiag;
    case Item::kPrm: return kPrm;
    case Item::kC1Answer: return kC1Answer;
    case Item::kC2Answer: return kC2Answer;
    case Item::kCfg: return kCfg;
    case Item::kC1Request: return kC1Request;
    case Item::kC2Request: return kC2Request;
    default: return kOutput;
  }
}

void Sequencer::start(Item item, Cycle now) {
  if (item == Item::kInputClear) return clear_input_error(now);
  if (item <= Item::kC2Answer) return start_read(now, area(item));
  if (item <= Item::kC2Request) return start_write(now, item);
  status_byte(item, now);
}

// The first byte moves in the cycle of the choice.
void Sequencer::start_read(Cycle now, const Area& area) {
  index_ = 0;
  image_size_ = area.header;
  goto_phase(Phase::kRead, now + area.header);
  read_byte();
}

void Sequencer::start_write(Cycle now, Item item) {
  profibus::UserMail& mail = user_.mail();
  const auto load = [this](const std::uint8_t* bytes, int size) {
    image_[static_cast<std::size_t>(image_size_++)] = static_cast<std::uint8_t>(size);
    std::copy_n(bytes, size, image_.begin() + image_size_);
    image_size_ += size;
  };
  image_size_ = 0;
  if (item == Item::kPrm) {
    load(mail.prm.block.bytes.data(), mail.prm.block.size);
    mail.prm.due.clear();
  } else if (item == Item::kCfg) {
    image_[0] = static_cast<std::uint8_t>(mail.cfg.output);
    image_[1] = static_cast<std::uint8_t>(mail.cfg.input);
    image_size_ = 2;
    load(mail.cfg.block.bytes.data(), mail.cfg.block.size);
    mail.cfg.due.clear();
  } else if (item == Item::kOutput) {
    const profibus::IoBlock& outputs = user_.outputs();
    load(outputs.bytes.data(), outputs.size);
    mail.output.due.clear();
    if ((chip_command1_ & regs::kChipCommand1Output) != 0) ++outputs_overwritten_;  // H5
  } else {
    profibus::AcyclicMail& acyclic = item == Item::kC1Request ? mail.c1 : mail.c2;
    image_size_ = acyclic.pdu.size;
    std::copy_n(acyclic.pdu.bytes.begin(), image_size_, image_.begin());
    acyclic.due.clear();
  }
  image_crc_ = crc16(image_.data(), image_size_);
  index_ = 0;
  goto_phase(Phase::kWrite, now + image_size_ + 2);  // the flag follows the two CRC bytes
  move(now);
}

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

static_assert(profibus::kBaudUnknown.code() == regs::kBaudSearching && profibus::kBaudCount == regs::kBaudRate9k6 + 1);

std::uint8_t Sequencer::status3() const {
  const int state = static_cast<int>(user_.mail().state.state);
  return static_cast<std::uint8_t>(user_.mail().baud.index.code() << regs::kChipStatus3BaudRateShift |
                                   state << regs::kChipStatus3DpStateShift);
}

// --- moving blocks ---------------------------------------------------------------------------------------------------

void Sequencer::read_byte() {
  const Area& block = area(item_);
  const bool crc = index_ >= image_size_ && phase_ == Phase::kReadRest;
  const int address = crc ? block.crc + (index_ - image_size_) : block.base + index_;
  image_[static_cast<std::size_t>(index_)] = get(static_cast<regs::Address>(address));
  ++index_;
  if (phase_ == Phase::kRead && index_ == image_size_) phase_ = Phase::kDecode;
  if (phase_ == Phase::kReadRest && index_ == image_size_ + 2) phase_ = Phase::kCheck;
}

void Sequencer::decode(Cycle now) {
  const Area& block = area(item_);
  if (block.maximum == 0) return goto_phase(Phase::kCommit, now + 1);  // a verdict: nothing follows
  const int length =
      acyclic_answer(item_) && !carries_data(image_[0]) ? 0 : image_[static_cast<std::size_t>(block.header - 1)];
  if (length > block.maximum) {
    image_size_ = 0;  // D12
    return goto_phase(Phase::kCommit, now + 1);
  }
  image_size_ += length;
  const Cycle rest = length + 2;
  goto_phase(Phase::kReadRest, now + rest + 2);  // then the check cycle, then the commit
}

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

void Sequencer::flag(Cycle now) {
  const bool acyclic = item_ == Item::kC1Request || item_ == Item::kC2Request;
  std::uint8_t& command = acyclic ? chip_command2_ : chip_command1_;
  command = static_cast<std::uint8_t>(command | area(item_).flag);
  put(acyclic ? regs::kChipCommand2 : regs::kChipCommand1, command);
  effect_ = now;
  if (item_ == Item::kPrm || item_ == Item::kCfg) told_user_ = now;  // P7
  next_item();
  goto_phase(Phase::kChoose, now + 1);
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
