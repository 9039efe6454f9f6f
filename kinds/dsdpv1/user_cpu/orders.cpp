#include "kinds/dsdpv1/user_cpu/orders.hpp"

#include <algorithm>
#include <stdexcept>
#include <variant>

namespace dsdpv1::user_cpu {
namespace {

command::Area area_of(const std::string& word) {
  const auto& words = block_words();
  const auto found = std::find(words.begin(), words.end(), word);
  return static_cast<command::Area>(found - words.begin());
}

struct ToDriver {
  template <class Same>
  DriverCommand operator()(const Same& same) const {
    return same;
  }
  DriverCommand operator()(const command::OfChip& of_chip) const {
    if (of_chip.order == kHoldDpram) return command::Hold{of_chip.duration};
    if (of_chip.order == kWrongCrc) return command::WrongCrc{area_of(of_chip.block), of_chip.times};
    if (of_chip.order == kEarlyRSta) return command::EarlyRSta{};
    if (of_chip.order == kFlipBit) return command::SpoilTelegrams{TelegramFault::kFlippedBit, of_chip.times};
    if (of_chip.order == kCutTelegram) return command::SpoilTelegrams{TelegramFault::kCut, of_chip.times};
    if (of_chip.order == kWrongParity) return command::SpoilTelegrams{TelegramFault::kWrongParity, of_chip.times};
    if (of_chip.order == kHostTelegram) return command::HostTelegram{of_chip.bytes, of_chip.listen, of_chip.times};
    if (of_chip.order == kSendBreak) return command::SpoilTelegrams{TelegramFault::kBreak, of_chip.times};
    if (of_chip.order == kTalkOverReply) return command::SpoilTelegrams{TelegramFault::kTalkOver, of_chip.times};
    if (of_chip.order == kPauseTelegram)
      return command::SpoilTelegrams{TelegramFault::kPause, of_chip.times, of_chip.duration};
    throw std::logic_error("no order of this chip: " + of_chip.order);
  }
};

}  // namespace

const std::vector<std::string>& block_words() {
  static const std::vector<std::string> words = {"init", "inputs", "diagnosis", "c1_answer", "c2_answer"};
  return words;
}

bool carry_out(const Command& command, HostBus& port) {
  const auto* order = std::get_if<command::OfChip>(&command);
  if (order == nullptr || order->order != kSpoilReads) return false;
  port.spoil_reads();
  return true;
}

DriverCommand driver_command(const Command& command) { return std::visit(ToDriver{}, command); }

std::string driver_error_code(dsdpv1_error error) {
#define X(name, value, text) \
  if (error == (name)) return #name;
  DSDPV1_ERROR_TABLE(X)
#undef X
  return "DSDPV1_ERR_UNKNOWN";
}

}  // namespace dsdpv1::user_cpu
