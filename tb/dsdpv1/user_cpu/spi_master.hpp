#pragma once
// A user CPU's SPI controller: frames of XSS on the pins, mode 0, MSB first (SP1), each edge at its tick.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tb/dsdpv1/user_cpu/serial_pins.hpp"
#include "tb/dsdpv1/user_cpu/transfer.hpp"

namespace dsdpv1::user_cpu {

/// In ticks of 1/12 ns. The defaults are 9 MHz (000 1.2), and an XSS that software moves.
struct SpiTiming {
  Tick high = 667, low = 666;  ///< of SCK
  Tick lead = 2400;            ///< XSS falls, SCK rises: 200 ns
  Tick lag = 2400;             ///< SCK falls, XSS rises
  Tick gap = 6000;             ///< XSS is high at least so long between two frames: 500 ns
  Tick byte_gap = 0;           ///< SCK stays low so much longer between two bytes
};

/// What goes wrong in a frame.
struct SpiFault {
  std::optional<std::size_t> flipped_bit;  ///< of MOSI, from 0
  std::optional<std::size_t> cut_after;    ///< bits after which XSS rises
};

/// MOSI changes with SCK's fall, the first bit with XSS's.
class SpiMaster : public Transfer {
 public:
  SpiMaster(SerialPins& pins, const SpiTiming& timing) : pins_(pins), timing_(timing) {}

  /// A frame, not before `at` nor before the gap is over. Bytes that a fault cuts off come in as FF.
  void begin(Tick at, std::vector<std::uint8_t> out, const SpiFault& fault = {});
  const std::vector<std::uint8_t>& received() const { return in_; }

  Tick next() const override { return done() ? bus::kNever : tick_of(edge_); }
  void run(Tick now) override;
  bool done() const override { return edge_ >= edges(); }

 private:
  std::size_t edges() const { return 2 * bits_ + 2; }
  Tick tick_of(std::size_t edge) const;
  bool bit(std::size_t number) const;
  void rise(Tick now, std::size_t number);
  void fall(Tick now, std::size_t number);

  SerialPins& pins_;
  SpiTiming timing_;
  std::vector<std::uint8_t> out_, in_;
  std::optional<std::size_t> flipped_;
  std::size_t bits_ = 0;  ///< of the frame
  std::size_t edge_ = 2;  ///< the next: XSS, then SCK's, then XSS
  Tick begin_ = 0, free_at_ = 0;
};

}  // namespace dsdpv1::user_cpu
