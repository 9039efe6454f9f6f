#include "model/dsdpv1/exchange.hpp"

#include <algorithm>
#include <iterator>

#include "model/profibus/dpv1_pdu.hpp"

namespace dsdpv1 {
namespace {

constexpr int kReads = 3;  // flag byte, B00E, B00F

// The byte and bit with which the user announces an area.
regs::Address flag_byte(std::uint16_t to) {
  return to == regs::kInput || to == regs::kDiag ? regs::kUserCommand1 : regs::kUserCommand2;
}
std::uint8_t flag_bit(std::uint16_t to) {
  switch (to) {
    case regs::kInput: return regs::kUserCommand1Input;
    case regs::kDiag: return regs::kUserCommand1Diag;
    case regs::kC1: return regs::kUserCommand2C1;
    default: return regs::kUserCommand2C2;
  }
}

}  // namespace

// News in the order in which they are checked (UA10), then the outputs.
const Exchange::Area Exchange::kAreas[kAreaCount] = {
    {regs::kPrm, 1, regs::kPrmDataSize, 0x10, regs::kChipCommand1Prm, false},
    {regs::kCfg, 3, regs::kCfgDataSize, 0x20, regs::kChipCommand1Cfg, false},
    {regs::kC1, 4, regs::kC1DataSize, 0x04, regs::kChipCommand2C1, true},
    {regs::kC2, 4, regs::kC2DataSize, 0x08, regs::kChipCommand2C2, true},
    {regs::kOutput, 1, regs::kOutputDataSize, 0x00, regs::kChipCommand1Output, false},
};

void Exchange::start(const Request& request, const std::uint8_t* data) {
  to_ = request.address;
  sent_ = request.length;
  block_ = data;
}

bool Exchange::move(int index, bool data_exch) {
  if (index == 0)
    flags_ = ram_.read(flag_byte(to_));
  else if (index == 1)
    chip_command1_ = ram_.read(regs::kChipCommand1);
  else if (index == 2)
    chip_command2_ = ram_.read(regs::kChipCommand2);
  else if (index < kReads + sent_)
    ram_.write(static_cast<regs::Address>(to_ + index - kReads), block_[index - kReads]);
  else if (index == kReads + sent_)
    ram_.write(flag_byte(to_), flags_ | flag_bit(to_));
  else
    return move_reply(index - kReads - sent_ - 1, data_exch);
  return false;
}

// `index` counts from the choice.
bool Exchange::move_reply(int index, bool data_exch) {
  if (index == 0) choose(data_exch);
  if (index < header_) {
    data_.at(static_cast<std::size_t>(index)) = ram_.read(static_cast<regs::Address>(area_->address + index));
    return false;
  }
  if (index == header_) {
    take_length();
    return rest_ == 0 && !clears();
  }
  const int place = index - 1;  // evaluating the length takes a cycle without a move
  if (place == header_ + rest_) {
    clear();
    return true;
  }
  data_.at(static_cast<std::size_t>(place)) = ram_.read(static_cast<regs::Address>(area_->address + place));
  return place == header_ + rest_ - 1 && !clears();
}

void Exchange::choose(bool data_exch) {
  const auto is_news = [this](const Area& area) {
    return ((area.second ? chip_command2_ : chip_command1_) & area.flag) != 0;
  };
  const Area* outputs = std::end(kAreas) - 1;
  area_ = to_ == regs::kInput ? std::find_if(std::begin(kAreas), outputs, is_news) : outputs;
  header_ = area_->header;
  rest_ = 0;
  function_ = area_->function | (data_exch ? 1 : 0);
}

void Exchange::take_length() {
  std::uint8_t& length = data_.at(static_cast<std::size_t>(header_ - 1));
  const bool acyclic = area_->second;
  if (acyclic && data_[0] != profibus::dpv1::kWrite && data_[0] != profibus::dpv1::kTransport) return;
  length = static_cast<std::uint8_t>(std::min<int>(length, area_->most));
  rest_ = length;
}

bool Exchange::clears() const {
  const std::uint8_t flags = area_->second ? chip_command2_ : chip_command1_;
  return to_ == regs::kInput && (flags & area_->flag) != 0;
}

void Exchange::clear() {
  const std::uint8_t flags = area_->second ? chip_command2_ : chip_command1_;
  ram_.write(area_->second ? regs::kChipCommand2 : regs::kChipCommand1,
             flags & static_cast<std::uint8_t>(~area_->flag));
}

bool Exchange::is_possible(int index) const {
  if (sent_ > HostTelegram::kMostData) return false;
  const int reply = index - kReads - sent_ - 1;
  if (reply <= 0) return true;
  if (area_ == nullptr || header_ != area_->header) return false;
  return reply <= header_ || reply - 1 < header_ + rest_ + (clears() ? 1 : 0);
}

std::uint8_t Exchange::length_byte() const {
  const bool cfg = cfg_length_ && area_->address == regs::kCfg;
  return static_cast<std::uint8_t>(cfg ? rest_ + 1 : size());
}

}  // namespace dsdpv1
