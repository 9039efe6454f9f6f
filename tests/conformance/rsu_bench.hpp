#pragma once
// A DSDPV1-RSU under test, three times: in step, in skip, and in skip with L_REQ and L_STA unwatched, so that it dozes.
// All get the same pins; every difference of pins, events or cells fails the test. And a host at its SPI or UART port.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bus/bytes.hpp"
#include "model/dsdpv1/chip.hpp"
#include "model/dsdpv1/reasons.hpp"
#include "registers/dsdpv1_regs.hpp"
#include "tests/conformance/host_telegrams.hpp"
#include "tests/conformance/twin_chip.hpp"

namespace dsdpv1::conformance {

using profibus::Cycle;

Bytes part_of(const Bytes& bytes, std::size_t from, std::size_t count);

struct Straps {
  HostMode mode = HostMode::kSpi;
  Level address = 1, rate = 7, interval = 0;
};

class RsuBench {
 public:
  explicit RsuBench(const Straps& straps = {}, Config config = {});

  Tick now() const { return now_; }
  Cycle cycle() const { return now_ / 250; }
  void set(Tick at, Pin pin, Level level);
  /// Compares the chips at `until`.
  void run_until(Tick until);
  void run_cycles(Cycle cycles) { run_until(now_ + cycles * 250); }
  /// RESET rises at tick 5000, R is edge 23; until the start-up access has ended.
  void power_on();
  void reset_for(Cycle cycles);

  std::uint8_t peek(std::uint16_t cell) const { return skip_.peek(cell); }
  Bytes peek(std::uint16_t cell, int count) const;
  void poke(std::uint16_t cell, std::uint8_t value);
  Level level(Pin pin) const { return skip_.level(pin); }
  Status status() const { return skip_.status(); }
  HostMode mode() const { return skip_.mode(); }

  const std::vector<PinChange>& trace() const { return skip_trace_; }
  std::vector<PinChange> changes(Pin pin) const;
  const std::vector<profibus::Event>& events() const { return skip_events_; }
  int count(profibus::Reason reason) const;
  /// The last event with this reason; fails the test when there is none.
  profibus::Event last(profibus::Reason reason) const;
  void forget_events();

  // --- SPI
  struct Frame {
    Tick high = 600, low = 600, lead = 600, lag = 600;
    int bits = 0;        ///< of the last byte: as many only; 0: all
    bool stays = false;  ///< XSS stays low at the end
  };
  /// XSS falls now; what MISO gave while `mosi` went out.
  Bytes spi(const Bytes& mosi, const Frame& frame);
  Bytes spi(const Bytes& mosi) { return spi(mosi, Frame()); }
  void xss(Level level) { set(now_, Pin::kXss, level); }
  /// More bytes of a frame that stays.
  Bytes clock(const Bytes& mosi, const Frame& frame = {600, 600, 600, 600, 0, true});
  /// A request and, in the same frame, so many bytes of reply; then 2.7 us of silence.
  Bytes ask(const Bytes& request, std::size_t reply);
  /// Reply of a read; without start, code and CRC, which are judged.
  Bytes read(std::uint16_t address, std::uint8_t length);
  /// Code of the reply to a write, whose form is judged.
  void write(std::uint16_t address, const Bytes& data);
  void claim();
  void release() { write(0x014, {0x00}); }

  // --- UART
  int bit() const { return bit_; }
  struct Character {
    bool parity_wrong = false, no_stop = false;
  };
  /// Characters without a gap, from now on; time is at the end of the last stop bit.
  void send(const Bytes& bytes);
  void send(std::uint8_t byte, const Character& how);
  /// The request, and what TXD gives from then on until it is silent for 100 bits; `limit` characters at most.
  Bytes talk(const Bytes& request);
  /// The characters that TXD has sent since `from`.
  Bytes sent_since(Tick from) const;

 private:
  void compare();

  Chip skip_, step_, doze_;
  std::vector<PinChange> skip_trace_, step_trace_, doze_trace_;
  std::vector<profibus::Event> skip_events_, step_events_, doze_events_;
  std::size_t pins_compared_ = 0, events_compared_ = 0, doze_compared_ = 0, doze_trace_compared_ = 0;
  Tick now_ = 0;
  int bit_ = 26;
  Restorer restorer_{500};
};

}  // namespace dsdpv1::conformance
