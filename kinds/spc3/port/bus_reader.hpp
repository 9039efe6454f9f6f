#pragma once
// The accesses of a user CPU to a chip of the SPC3 family, derived from the pins of its bus alone.
#include <string>

#include "bus/bytes.hpp"
#include "bus/time.hpp"
#include "model/spc3/bus_lines.hpp"
#include "tb/chip/checks/spi_frame_reader.hpp"
#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::spc3_bus {

using bus::Tick;
using tb::Level;

/// One byte.
struct BusAccess {
  bool write = false;
  Level address = tb::kLevelX;  ///< in Intel order, at the begin and then at the answer or the end; kLevelX: unknown
  Level data = tb::kLevelX;     ///< of a write at its end, of a read its answer; kLevelX: unknown or none
  Tick began = 0;
};

/// A frame of SPI, from XSS's fall to its rise.
struct SpiFrame {
  Tick began = 0, ended = 0;
  bus::Bytes out, in;  ///< of MOSI and MISO: instruction, two of the address, data
  unsigned bits = 0;   ///< of a byte that XSS has cut

  static constexpr std::size_t kHead = 3;
  bool is_known() const { return !out.empty() && (out[0] & 0xEE) == 0x02; }
  bool is_read() const { return (out[0] & 1) != 0; }
  bool is_array() const { return out[0] < 0x10; }
  unsigned address() const { return static_cast<unsigned>(out[1]) << 8 | out[2]; }
  std::size_t data() const { return out.size() < kHead ? 0 : out.size() - kHead; }
};

/// "read 016, 3 bytes"; what is wrong with it, "" if nothing.
std::string words_of(const SpiFrame& frame);
std::string wrong_with(const SpiFrame& frame);

class AccessSink {
 public:
  virtual ~AccessSink() = default;
  virtual void access_began(const BusAccess& /*access*/) {}
  /// DB has the answer of a read.
  virtual void read_answered(Tick /*at*/, const BusAccess& /*access*/) {}
  virtual void access_ended(Tick /*at*/, const BusAccess& /*access*/) {}
  /// By SPI each byte of data is an access; known after the frame's end.
  virtual void frame_ended(const SpiFrame& /*frame*/) {}
};

/// The straps of a board and its strobes at rest, from power-on; `set(pin, level)`.
template <class Set>
void strap(spc3::Bus bus, const Set& set) {
  set(spc3::Pin::kXIntMot, Level{spc3::is_motorola(bus)});
  set(spc3::Pin::kMode, Level{spc3::is_synchronous(bus)});
  set(spc3::Pin::kXWr, Level{bus != spc3::Bus::kMotorolaSync});
  set(spc3::Pin::kAle, Level{bus == spc3::Bus::kMotorolaAsync});
  if (bus == spc3::Bus::kSpi) set(spc3::Pin::kSerial, Level{1});
}

/// Accesses by SPI (A59).
class SpiReader : private tb::SpiFrameReader {
 public:
  SpiReader(AccessSink& sink, unsigned mode) : SpiFrameReader(mode), sink_(sink) {}

  void pin(Tick at, spc3::Pin pin, Level level);
  using SpiFrameReader::forget_frame;
  using SpiFrameReader::frame_end;
  using SpiFrameReader::pass;

 private:
  void frame_began(Tick at) override;
  void byte(Tick at, std::uint8_t mosi, std::uint8_t miso) override;
  void frame_ended(Tick at) override;

  AccessSink& sink_;
  SpiFrame frame_;
};

class BusReader {
 public:
  /// `bus`: the straps, until pin() moves them. `spi_mode`: as the chip's parameter.
  explicit BusReader(AccessSink& sink, spc3::Bus bus = spc3::Bus::kIntelAsync, unsigned spi_mode = 0)
      : sink_(sink), spi_(sink, spi_mode) {
    strap(
        bus, [this](spc3::Pin pin, Level level) { lines_.set(pin, level); });
  }

  /// A change of a pin of spc3::Pin, in order of time; inputs at one tick in the order of their numbers.
  void pin(Tick at, tb::PinNumber pin, Level level);
  const spc3::BusLines& lines() const { return lines_; }
  bool accessing() const { return running_; }
  /// The end of a frame of SPI that XSS's rise has closed, and time that passes.
  Tick frame_end() const { return spi_.frame_end(); }
  void pass(Tick at) { spi_.pass(at); }

 private:
  void reset(bool high);
  void serial(Tick at, spc3::Pin pin, Level level);
  void follow(Tick at);

  AccessSink& sink_;
  spc3::BusLines lines_;
  SpiReader spi_;
  BusAccess access_;
  bool in_reset_ = true, running_ = false;
};

}  // namespace dsdpv1::spc3_bus
