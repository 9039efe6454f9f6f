#include "kinds/dsdpv1/keys/serial_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/port/spi_reader.hpp"
#include "kinds/dsdpv1/port/uart_reader.hpp"
#include "kinds/dsdpv1/user_cpu/orders.hpp"

namespace dsdpv1::tb {
namespace {

using keys::ObjectOf;
using keys::Range;

const ObjectOf<SpiKeys>& spi_keys() {
  static const ObjectOf<SpiKeys> keys = [] {
    using S = SpiKeys;
    ObjectOf<S> o(
        "spi",
        "The native user CPU's SPI controller, on a chip with mode: spi (an ARM board's firmware sets its own). "
        "Times beyond the chip's limits (SP2) are "
        "reported as violations.");
    add_spi_times(o);
    o.integer("spare", &S::spare, {0, static_cast<int>(DSDPV1_SPI_SPARE)}, "bytes",
              "Greatest delay of a reply after the request (SP6).");
    return o;
  }();
  return keys;
}

const ObjectOf<UartKeys>& uart_keys() {
  static const ObjectOf<UartKeys> keys = [] {
    using U = UartKeys;
    ObjectOf<U> o("uart",
                  "The native user CPU's UART, on a chip with mode: uart (an ARM board's firmware sets its own).");
    o.integer("rate", &U::rate, {9600, 1'843'200}, "bit/s", "Its baud rate (default: the chip's uart_rate).");
    o.time("gap", &U::gap, {0, bus::kTicksPerSecond}, "Idle time between two characters of a telegram.");
    return o;
  }();
  return keys;
}

constexpr std::array<int, 8> kRates = {9600, 19'200, 38'400, 57'600, 115'200, 230'400, 460'800, 1'843'200};  // UA1

/// Actions that only a DSDPV1's program supports. SPI and UART do not check block CRCs (SP15) and leave the handshake's
/// pins unused (R14), and the UART has no ownership (UA6).
std::vector<std::string> orders_for(CpuKind kind, HostMode mode) {
  using user_cpu::kCutTelegram, user_cpu::kEarlyRSta, user_cpu::kFlipBit, user_cpu::kHoldDpram, user_cpu::kHostTelegram,
      user_cpu::kPauseTelegram, user_cpu::kSendBreak, user_cpu::kSpoilReads, user_cpu::kTalkOverReply,
      user_cpu::kWrongCrc, user_cpu::kWrongParity;
  if (mode == HostMode::kParallel) return {kHoldDpram, kWrongCrc, kEarlyRSta, kSpoilReads};
  const bool firmware =
      kind == CpuKind::kArm;  // it can disturb its telegrams (DSDPV1_SPOIL_ of its mailbox), nothing more
  if (mode == HostMode::kSpi && firmware) return {kHoldDpram, kFlipBit, kCutTelegram, kSpoilReads};
  if (mode == HostMode::kSpi) return {kHoldDpram, kFlipBit, kCutTelegram, kHostTelegram, kSpoilReads};
  if (firmware) return {kFlipBit, kCutTelegram, kWrongParity, kSpoilReads};
  return {kFlipBit, kCutTelegram, kWrongParity, kSendBreak, kPauseTelegram, kTalkOverReply, kHostTelegram, kSpoilReads};
}

/// Straps; SPI1 and USART2, SPI2; RESET and INTR0 of card 2.
bool is_of_the_card(const Switch& one) {
  static constexpr std::array<unsigned, 7> kPins = {0x00FE, 0xF003, 0x0C00, 0x1700, 0xE020, 0, 0};
  return (kPins.at(one.port) >> one.pin & 1U) != 0;
}

user_cpu::SpiPort spi_port(const SpiKeys& keys) {
  user_cpu::SpiPort port;
  port.timing = spi_timing_of(keys);
  port.spare = static_cast<std::uint8_t>(keys.spare);
  return port;
}

user_cpu::UartPort uart_port(const UartKeys& keys, const Dsdpv1Settings& chip) {
  user_cpu::UartPort port;
  port.timing.baud = keys.rate != 0 ? keys.rate : kRates.at(static_cast<std::size_t>(chip.uart_rate));
  port.timing.gap = keys.gap;
  port.interval = static_cast<std::uint16_t>(chip.uart_gaps.at(static_cast<std::size_t>(chip.interval)));
  port.tsdr = static_cast<std::uint16_t>(chip.uart_min_tsdr);
  return port;
}

/// The firmware sets its own speed, and the free pins depend on the chip.
void check_board_port(const Dsdpv1User& user, const Dsdpv1Settings& chip, const std::string& file) {
  const auto refuse = [&](int where, const char* key) {
    throw InputError(file, where,
                     fmt::format("{} is that of kind: native, an ARM board has the firmware's registers", key));
  };
  if (user.spi) refuse(user.spi->line, "spi");
  if (user.uart) refuse(user.uart->line, "uart");
  if (!dsdpv1::has_serial_ports(chip.part)) return;
  for (const Name& text : user.switches)
    if (is_of_the_card(*parse_switch(text.text)))
      throw InputError(file, text.line,
                       fmt::format("switches holds {}, a pin that the board wires to the straps and ports of a "
                                   "DSDPV1-RSU; expected the others",
                                   text.text));
}

}  // namespace

SerialSettings serial_settings_of(const Dsdpv1Settings& chip) {
  const Straps straps = straps_of(chip);
  return {straps[0],          straps[1],           straps[2],      straps[3],         chip.spi_write_gap,
          chip.spi_reply_gap, chip.spi_miso_delay, chip.uart_gaps, chip.uart_min_tsdr};
}

std::unique_ptr<HostReader> host_reader_of(const Dsdpv1Settings& chip) {
  if (chip.mode == HostMode::kSpi) return std::make_unique<SpiReader>();
  if (chip.mode == HostMode::kUart) return std::make_unique<UartReader>(serial_settings_of(chip));
  return nullptr;
}

void add_serial_ports(ObjectOf<Dsdpv1User>& user) {
  user.object("spi", &Dsdpv1User::spi, spi_keys(), "Its end of SPI.");
  user.object("uart", &Dsdpv1User::uart, uart_keys(), "Its end of the UART.");
}

user_cpu::HostPort host_port_of(const Dsdpv1User& user, const Dsdpv1Settings& chip) {
  user_cpu::HostPort port;
  port.address = static_cast<std::uint8_t>(chip.address);
  port.block_crc = chip.serial_block_crc != 0;
  if (chip.mode == HostMode::kSpi) port.port = spi_port(user.spi.value_or(SpiKeys()));
  if (chip.mode == HostMode::kUart) port.port = uart_port(user.uart.value_or(UartKeys()), chip);
  return port;
}

void check_port(const Dsdpv1User& user, const Dsdpv1Settings& chip, const std::string& file, const std::string& slave,
                int line) {
  if (user.kind == CpuKind::kArm) check_board_port(user, chip, file);
  const char* mode = mode_name(chip.mode);
  const auto refuse = [&](int where, const char* key, const char* allowed) {
    throw InputError(file, where, fmt::format("{} with mode: {} of the chip, expected {}", key, mode, allowed));
  };
  if (user.spi && chip.mode != HostMode::kSpi) refuse(user.spi->line, "spi", "mode: spi");
  if (user.spi) check_mosi(*user.spi, file);
  if (user.uart && chip.mode != HostMode::kUart) refuse(user.uart->line, "uart", "mode: uart");
  if (chip.mode == HostMode::kParallel) return;
  if (user.access) refuse(user.access->line, "access", "mode: parallel");
  if (user.fsmc) refuse(user.fsmc->line, "fsmc", "mode: parallel");
  if (chip.address < 1 || chip.address > 2)
    throw InputError(file, line,
                     fmt::format("address is {}, to which no telegram of slave {}'s user CPU can go, expected 1 and 2",
                                 chip.address, slave));
}

void check_order(const std::string& order, CpuKind kind, HostMode mode, const std::string& file, int line) {
  const std::vector<std::string> useful = orders_for(kind, mode);
  if (std::find(useful.begin(), useful.end(), order) != useful.end()) return;
  throw InputError(file, line,
                   fmt::format("{} is of no use with mode: {} of the chip{}, expected {}", order, mode_name(mode),
                               kind == CpuKind::kArm ? " and kind: arm" : "", fmt::join(useful, ", ")));
}

}  // namespace dsdpv1::tb
