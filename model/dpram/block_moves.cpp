// Moves blocks between the DPRAM and the slave, byte by byte (rulings D3, D6, D12, V14): the place of each area, the
// length of its block, and its CRC.
#include <algorithm>

#include "model/dpram/crc16.hpp"
#include "model/dpram/sequencer.hpp"

namespace dsdpv1::dpram {
namespace {

// An acyclic answer has the length in its length byte only if it carries data (V14).
bool carries_data(std::uint8_t function) {
  return function == profibus::dpv1::kRead || function == profibus::dpv1::kTransport;
}

}  // namespace

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

// The first byte moves in the cycle of the choice.
void Sequencer::start_read(Cycle now, const Area& area) {
  index_ = 0;
  image_size_ = area.header;
  goto_phase(Phase::kRead, now + area.header);
  read_byte();
}

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

void Sequencer::write_byte() {
  put(static_cast<regs::Address>(area(item_).base + index_), image_[static_cast<std::size_t>(index_)]);
  if (++index_ == image_size_) phase_ = Phase::kCrcHigh;
}

void Sequencer::write_crc() {
  const bool high = phase_ == Phase::kCrcHigh;
  const auto address = static_cast<regs::Address>(area(item_).crc + (high ? 0 : 1));
  put(address, static_cast<std::uint8_t>(high ? image_crc_ >> 8 : image_crc_ & 0xFF));
  phase_ = high ? Phase::kCrcLow : Phase::kFlag;
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

}  // namespace dsdpv1::dpram
