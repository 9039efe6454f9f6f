#include "kinds/xgate/orders.hpp"

#include <fmt/format.h>

#include "io/input/input_error.hpp"
#include "io/input/units.hpp"

namespace dsdpv1::xgate {
namespace {

using user_cpu::command::OfChip;

std::string said_flip(const OfChip& order) { return fmt::format("a wrong bit in {} commands", order.times); }
std::string said_cut(const OfChip& order) { return fmt::format("{} commands end too early", order.times); }
std::string said_talk(const OfChip& order) { return fmt::format("talks over {} answers", order.times); }
std::string said_pause(const OfChip& order) {
  return fmt::format("pauses for {} in {} commands", tb::time_text(order.duration), order.times);
}
std::string said_telegram(const OfChip& order) { return "sends " + tb::bytes_text(order.bytes) + " and the XOR"; }

}  // namespace

const std::vector<tb::Order>& orders() {
  static const std::vector<tb::Order> all = {
      {{kFlipBit, "The next commands of the host have a wrong bit, in XOR.", {"slave"}, {"times"}}, said_flip},
      {{kCutTelegram,
        "The next commands of the host end after two bytes, by SPI within the third one.",
        {"slave"},
        {"times"}},
       said_cut},
      {{kPauseTelegram, "The next commands of the host pause before the third byte.", {"slave", "for"}, {"times"}},
       said_pause},
      {{kTalkOverReply, "The host sends FF 20 bit times after its next commands. UART.", {"slave"}, {"times"}},
       said_talk},
      {{kHostTelegram,
        "Before its next command the host sends these bytes, right or wrong, and their XOR. It reads `listen` bytes of "
        "the answer (default: all of it).",
        {"slave", "bytes"},
        {"times", "listen"}},
       said_telegram}};
  return all;
}

void check_order(const std::string& order, HostCpu cpu, Port port, const std::string& file, int line) {
  if (cpu == HostCpu::kArm)
    throw tb::InputError(file, line, fmt::format("{} is of no use with kind: arm, expected kind: native", order));
  if (order == kTalkOverReply && port == Port::kSpi)
    throw tb::InputError(file, line,
                         fmt::format("{} is of no use with port: spi of the chip, expected port: uart", order));
}

void LineFaults::add(const OfChip& order) { waiting_.push_back(order); }

OfChip LineFaults::take() {
  OfChip fault = waiting_.front();
  if (--waiting_.front().times <= 0) waiting_.pop_front();
  return fault;
}

}  // namespace dsdpv1::xgate
