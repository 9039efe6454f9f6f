#include "kinds/board/memory_bus.hpp"

#include <fmt/format.h>

#include <utility>

namespace dsdpv1::arm {
namespace {

constexpr PortPin kNe1 = {kD, 7}, kNoe = {kD, 4}, kNwe = {kD, 5}, kNwait = {kD, 6};
constexpr std::array<PortPin, 11> kAddress = {
    {{kF, 0}, {kF, 1}, {kF, 2}, {kF, 3}, {kF, 4}, {kF, 5}, {kF, 12}, {kF, 13}, {kF, 14}, {kF, 15}, {kG, 0}}};
constexpr std::array<PortPin, 8> kData = {{{kD, 14}, {kD, 15}, {kD, 0}, {kD, 1}, {kE, 7}, {kE, 8}, {kE, 9}, {kE, 10}}};

void add(std::string& list, const PortPin& line, const std::string& name) {
  list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", pin_name(line), name);
}

bool is_input(const Gpio& port, unsigned pin) {
  return !port.is_output(pin) && !port.is_alternate(pin) && !port.is_analog(pin);
}

}  // namespace

std::string pin_name(const PortPin& at) { return fmt::format("P{}{}", static_cast<char>('A' + at.port), at.pin); }

MemoryBus memory_bus(const std::array<Gpio, 7>& ports, const Fsmc& fsmc, bool handshake, bool wait) {
  MemoryBus bus;
  bus.wide = fsmc.is_wide();
  bus.multiplexed = fsmc.is_multiplexed();
  const auto passes = [&](const PortPin& line, const std::string& name) {
    const bool is = ports.at(line.port).is_pushed_alternate(line.pin);
    if (!is) add(bus.wrong_pins, line, name);
    return is;
  };
  const bool selects = passes(kNe1, "NE1");
  bus.reads = passes(kNoe, "NOE") && selects;
  bus.writes = passes(kNwe, "NWE") && selects;
  for (unsigned i = 0; i < kAddress.size(); ++i)
    if (!passes(kAddress.at(i), fmt::format("A{}", i))) bus.address &= static_cast<std::uint16_t>(~(1U << i));
  for (unsigned i = 0; i < kData.size(); ++i)
    if (!passes(kData.at(i), fmt::format("D{}", i))) bus.data &= static_cast<std::uint8_t>(~(1U << i));
  if (wait && !is_input(ports.at(kNwait.port), kNwait.pin)) add(bus.wrong_pins, kNwait, "NWAIT");
  if (!handshake) return bus;
  for (const auto& [line, name] : {std::pair(kRReq, "R_REQ"), std::pair(kRSta, "R_STA")})
    if (!ports.at(line.port).is_pushed(line.pin)) add(bus.wrong_pins, line, name);
  for (const auto& [line, name] : {std::pair(kLReq, "L_REQ"), std::pair(kLSta, "L_STA")})
    if (ports.at(line.port).is_analog(line.pin)) add(bus.wrong_pins, line, name);
  return bus;
}

}  // namespace dsdpv1::arm
