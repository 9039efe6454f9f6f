#pragma once
// The SPI port of the mailbox: mode 0 (MOSI is sampled at SCK's rise, MISO shifts at its fall), MSB first, one frame a
// select. Between profibus::UserSide and the pins there is nothing else: no RAM, no handshake.
//
//   01 write inputs   8 bytes of inputs for the slave
//   02 read outputs   8 bytes, in which MISO shows the outputs; INT rises
//   03 start          station address, ident high, ident low, flags (00): through OFFLINE to WAIT_PRM
//
// SCK and XSS are asynchronous to CLK. The shift register is clocked by SCK itself, at the tick of its edge. A frame is
// complete when XSS rises, and acts at the second rising CLK edge strictly after that: the first samples XSS, the
// second uses what was sampled. One that ends before the frame in front of it has acted is lost; no whole frame is that
// short.
#include <array>
#include <cstdint>

#include "tests/mailbox/pins.hpp"

namespace dsdpv1::mailbox {

constexpr int kDataBytes = 8;  ///< inputs, and outputs
/// The configuration, which is fixed: 8 bytes of inputs, 8 bytes of outputs (EN 50170's identifiers, compact form).
constexpr std::array<std::uint8_t, 2> kConfiguration = {0x17, 0x27};
/// Neither user parameters nor acyclic data; of the configuration exactly kConfiguration.
constexpr profibus::Capacities kCapacities = {0, static_cast<int>(kConfiguration.size()), kDataBytes, 0};

namespace command {
constexpr std::uint8_t kWriteInputs = 0x01, kReadOutputs = 0x02, kStart = 0x03;
}
constexpr int kDataFrame = 1 + kDataBytes;  ///< bytes of 01 and 02: the command and the data
constexpr int kStartFrame = 1 + 4;          ///< bytes of 03: the command, address, ident (2), flags

using Data = std::array<std::uint8_t, kDataBytes>;

class SpiPort : public kit::UserPort {
 public:
  explicit SpiPort(kit::Chip& chip) : chip_(chip) {}

  /// A frame that began before the reset is none.
  void reset() override;
  void input(Tick at, PinNumber pin, Level level) override;
  /// A complete frame takes effect.
  void eval(Cycle now) override;
  /// INT: low from the edge at which the slave has new outputs until the frame that has read them acts.
  void show(Cycle now) override { chip_.drive_at(now, kInt, unread_ || outputs_wait() ? 0 : 1); }
  Cycle next() const override { return acts_at_; }

 private:
  bool outputs_wait() const { return chip_.user().mail().output.due.waiting(); }
  void chip_select(Tick at, bool high);
  void begin();
  void end(Tick at);
  void shift_in();
  void shift_out();
  void load_outputs();
  void execute(Cycle now);
  void start(Cycle now);

  kit::Chip& chip_;
  bool selected_ = false;
  unsigned bits_ = 0;  // in this select
  std::array<std::uint8_t, kDataFrame> shift_{};
  std::uint64_t to_send_ = 0;  // the next bit for MISO is the highest
  Level miso_ = 0;

  Cycle acts_at_ = profibus::kNever;
  unsigned frame_bits_ = 0;
  std::array<std::uint8_t, kDataFrame> frame_{};
  bool unread_ = false;  // outputs that a frame has loaded but not yet read completely
};

}  // namespace dsdpv1::mailbox
