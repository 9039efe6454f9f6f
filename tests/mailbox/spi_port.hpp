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

#include "model/profibus/event_log.hpp"
#include "model/profibus/user_side.hpp"
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

class SpiPort {
 public:
  SpiPort(profibus::EventLog& log, profibus::UserSide& user) : log_(log), user_(user) {}

  /// In reset the port takes no frame; after `release` the next fall of XSS begins the first one.
  void reset();
  void release() { enabled_ = true; }
  /// A change of XSS, SCK or MOSI at `at`.
  void set(Tick at, Pin pin, bool high);
  bool level(Pin pin) const;

  /// The rising edge of `now`: a complete frame takes effect. Must be called before the station's.
  void eval(Cycle now);
  Cycle next() const { return acts_at_; }

  Level miso() const { return selected_ ? miso_ : kLevelZ; }
  /// INT: low from the edge at which the slave has new outputs until the frame that has read them acts.
  bool int_level() const { return !unread_ && !user_.mail().output.due.waiting(); }

 private:
  void chip_select(Tick at, bool high);
  void begin();
  void end(Tick at);
  void shift_in();
  void shift_out();
  void load_outputs();
  void execute(Cycle now);
  void start(Cycle now);

  profibus::EventLog& log_;
  profibus::UserSide& user_;
  bool enabled_ = false, xss_ = true, sck_ = false, mosi_ = false;

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
