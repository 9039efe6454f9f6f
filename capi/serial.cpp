// SPI and UART of a chip's user: whole frames and characters at the pins, with the same edges as those of tb's user
// CPUs.
#include "capi/serial.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "capi/chip.hpp"
#include "capi/names.hpp"
#include "capi/sized.hpp"
#include "model/dsdpv1/serial_host.hpp"

namespace dsdpv1::capi {

void UserUart::set_rate(const UartTiming& timing, Tick now) {
  timing_ = timing;
  restart(now);
}

void UserUart::restart(Tick now) {
  receiver_ = user_cpu::UartReceiver(timing_);
  idle_ = false;
  high_since_ = now;
}

void UserUart::txd_changed(Tick at, bool level) {
  if (!idle_ && !level) idle_ = at - high_since_ >= character();
  if (level) high_since_ = at;
  if (idle_) receiver_.txd_changed(at, level);
}

void UserUart::take(Tick now, std::vector<std::uint8_t>& bytes, std::size_t capacity) {
  receiver_.begin(now, capacity - bytes.size(), 0);
  receiver_.run(now);
  bytes.insert(bytes.end(), receiver_.received().begin(), receiver_.received().end());
}

Tick UserUart::quiet_until(Tick now) {
  receiver_.begin(now, 1, bus::kTicksPerSecond);
  const Tick next = receiver_.next();
  return next < now + bus::kTicksPerSecond ? std::max(next, now) : now + character() - half_bits(timing_, 2);
}

}  // namespace dsdpv1::capi

namespace {

using capi::fail;
using capi::guarded;
using capi::need;
using capi::Tick;
using dsdpv1::SerialEdge;
using dsdpv1::SpiFrame;
using dsdpv1::SpiTiming;
using dsdpv1::UartTelegram;
using dsdpv1::UartTiming;
using dsdpv1::user_cpu::UartReceiver;

/// A kind's serial port, and what chooses it: the level of a strap, or a parameter.
struct Choice {
  const char* kind;
  const char* chosen_by;
  int value;
  bool strap;
};
struct SpiRow {
  Choice choice;
  const char* select;
  Tick bit;  ///< usual: 9 MHz (000 1.2); of an XGate-DPS10 1 MHz, of at most 6 (4.7.2)
};
struct UartRow {
  Choice choice;
  bool parity;
};

constexpr std::array<SpiRow, 3> kSpi = {{{{"dsdpv1_rsu", "MODE", 1, true}, "XSS", 1333},
                                         {{"vpc3", "SERIAL", 1, true}, "XSS", 1333},
                                         {{"xgate", "port", 1, false}, "NSS", 12'000}}};
constexpr std::array<UartRow, 2> kUart = {
    {{{"dsdpv1_rsu", "MODE", 2, true}, true}, {{"xgate", "port", 0, false}, false}}};

tb::PinNumber pin_named(const dpsim_chip& chip, const char* name) {
  const tb::PinTable& pins = chip.kind.chip.pins();
  const auto found =
      std::find_if(pins.begin(), pins.end(), [name](const auto& pin) { return std::strcmp(pin.name, name) == 0; });
  return static_cast<tb::PinNumber>(found - pins.begin());
}

/// The row of the chip's kind; throws for a kind without one, and for a chip whose strap or parameter chooses another.
template <class Rows>
const auto& row_of(const Rows& rows, const dpsim_chip& chip, const char* port) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&chip](const auto& each) {
    return std::strcmp(each.choice.kind, chip.kind.chip.name()) == 0;
  });
  if (row == rows.end())
    fail(DPSIM_ERR_UNSUPPORTED, "a chip of this kind has no " + std::string(port) + " for its user");
  const Choice& choice = row->choice;
  const std::int64_t chosen =
      choice.strap ? chip.level(pin_named(chip, choice.chosen_by)) : chip.parameter(choice.chosen_by);
  if (chosen != choice.value)
    fail(DPSIM_ERR_UNSUPPORTED, std::string(choice.strap ? "the strap " : "the parameter ") + choice.chosen_by +
                                    " chooses another port than " + port + ", expected " +
                                    std::to_string(choice.value));
  return *row;
}

SpiTiming timing_of(const dpsim_spi_timing* given, const SpiRow& row, const dpsim_chip& chip) {
  const dpsim_spi_timing own = capi::options_of(given, "timing");
  capi::need_range("bit", own.bit, 0, bus::kTicksPerMs);
  capi::need_range("byte_gap", own.byte_gap, 0, bus::kTicksPerMs);
  const Tick bit = own.bit == 0 ? row.bit : std::max<Tick>(own.bit, 2);
  SpiTiming timing;
  timing.high = (bit + 1) / 2;
  timing.low = bit / 2;
  timing.byte_gap = own.byte_gap;
  timing.mode = static_cast<unsigned>(chip.parameter("spi_mode"));
  return timing;
}

/// Carries out the edges of one frame.
Tick transfer(dpsim_chip& chip, const SpiRow& row, Tick begin, SpiFrame& frame) {
  const tb::PinNumber sck = pin_named(chip, "SCK"), mosi = pin_named(chip, "MOSI"), miso = pin_named(chip, "MISO");
  const tb::PinNumber select = pin_named(chip, row.select);
  for (std::size_t number = 0; number < frame.size(); ++number) {
    const SerialEdge edge = frame[number];
    const Tick at = begin + edge.at;
    switch (edge.pin) {
      case dsdpv1::Pin::kMiso:
        chip.advance(at - 1);
        frame.sampled(chip.level(miso) != 0);
        break;
      case dsdpv1::Pin::kSck: chip.set(at, sck, edge.level ? 1 : 0); break;
      case dsdpv1::Pin::kMosi: chip.set(at, mosi, edge.level ? 1 : 0); break;
      default: chip.set(at, select, edge.level ? 1 : 0);
    }
  }
  return begin + frame.duration();
}

}  // namespace

dpsim_status dpsim_chip_spi(dpsim_chip* chip, uint64_t tick, const dpsim_spi_timing* timing, const uint8_t* out,
                            uint8_t* in, size_t count, uint64_t* end) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        need(out, "out");
        capi::need_range("count", static_cast<long long>(count), 1, 4096);
        const SpiRow& row = row_of(kSpi, *chip, "SPI");
        const SpiTiming own = timing_of(timing, row, *chip);
        const Tick begin = capi::tick_from(tick, chip->clock.now);
        const capi::Running running(chip->clock);
        chip->set(begin, pin_named(*chip, "SCK"), (own.mode & 2U) != 0 ? 1 : 0);
        SpiFrame frame({out, out + count}, own);
        const Tick ends = transfer(*chip, row, begin + own.gap, frame);
        chip->clock.now = ends;
        chip->changes.check();
        if (in != nullptr) std::copy(frame.received().begin(), frame.received().end(), in);
        if (end != nullptr) *end = capi::tick_out(ends);
      });
}

dpsim_status dpsim_chip_uart_open(dpsim_chip* chip, uint32_t rate) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        const UartRow& row = row_of(kUart, *chip, "UART");
        capi::need_range("rate", rate, 1200, 3'000'000);
        capi::need_outside(chip->clock);
        chip->open_uart(pin_named(*chip, "TXD"), {rate, 0, row.parity});
      });
}

dpsim_status dpsim_chip_uart_send(dpsim_chip* chip, uint64_t tick, const uint8_t* bytes, size_t count, uint64_t* end) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        capi::need_buffer(bytes, count, "bytes");
        const UartTelegram telegram({bytes, bytes + count}, chip->uart().timing());
        const Tick begin = capi::tick_from(tick, chip->clock.now);
        const capi::Running running(chip->clock);
        const tb::PinNumber rxd = pin_named(*chip, "RXD");
        for (std::size_t number = 0; number < telegram.size(); ++number)
          chip->set(begin + telegram[number].at, rxd, telegram[number].level ? 1 : 0);
        const Tick ends = begin + telegram.duration();
        chip->advance(ends);
        chip->clock.now = ends;
        chip->changes.check();
        if (end != nullptr) *end = capi::tick_out(ends);
      });
}

dpsim_status dpsim_chip_uart_receive(dpsim_chip* chip, uint64_t until, uint8_t* bytes, size_t capacity, size_t* count) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        capi::need_buffer(bytes, capacity, "bytes");
        need(count, "count");
        capi::UserUart& uart = chip->uart();
        const Tick last = capi::tick_from(until, chip->clock.now);
        const capi::Running running(chip->clock);
        std::vector<std::uint8_t> received;
        for (uart.take(chip->clock.now, received, capacity); received.size() < capacity && chip->clock.now < last;
             uart.take(chip->clock.now, received, capacity)) {
          const Tick to = std::min(last, uart.quiet_until(chip->clock.now));
          chip->advance(to);
          chip->clock.now = to;
        }
        chip->changes.check();
        std::copy(received.begin(), received.end(), bytes);
        *count = received.size();
      });
}
