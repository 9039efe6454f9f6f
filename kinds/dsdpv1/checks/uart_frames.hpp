#pragma once
// The UART port: characters and telegrams on RXD, the silences between them, and the time of TXD's reply (UA1 to UA5,
// UA16).
#include <optional>
#include <string>

#include "bus/wire/uart.hpp"
#include "kinds/dsdpv1/checks/check.hpp"
#include "kinds/dsdpv1/checks/host_telegram.hpp"
#include "kinds/dsdpv1/checks/rxd_sampler.hpp"
#include "kinds/dsdpv1/checks/serial_accesses.hpp"
#include "kinds/dsdpv1/checks/serial_settings.hpp"
#include "model/dsdpv1/pins.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

/// RXD and TXD may change at the same tick in any order.
class UartFrames {
 public:
  /// `settings` and `duties` must outlive it.
  UartFrames(Recorder& recorder, const SerialSettings& settings, UserDuties& duties);

  void reset(Tick at, bool in_reset);
  /// A change of a pin, in reset too.
  void pin(Tick at, Pin pin, Level level);
  /// Time advances to `at` without a change.
  void pass(Tick at) { advance(at); }
  void finish(Tick end);
  /// A bit in ticks, by UBR.
  Tick bit_ticks() const { return bit() * kTicksPerCycle; }

 private:
  enum class State : std::uint8_t {
    kOff,
    kWait,   ///< for a telegram's first character
    kIn,     ///< a telegram
    kDeaf,   ///< until a silence
    kReply,  ///< a telegram is complete and not yet replied: RXD is ignored
  };
  /// A sampled stop bit; its margin is known at RXD's next edge.
  struct StopBit {
    RxdCharacter character;
    Tick rose;           ///< RXD's last rise before it
    std::size_t number;  ///< of the character
  };

  /// A change of RXD.
  struct Edge {
    Tick at;
    bool level;
  };

  Tick bit() const { return settings_.bit(); }
  void advance(Tick at);
  void note_rxd(Tick at, bool level);
  void rxd(Tick at, bool level);
  void txd_fell(Tick at);

  void character(const RxdCharacter& character);
  void begin_telegram();
  bool in_time(const RxdCharacter& character);
  bool is_silence_over(const RxdCharacter& character);
  void hear(const RxdCharacter& character);
  void follow(const RxdCharacter& character);
  void request_complete(const RxdCharacter& last);
  void note_registers();
  /// First tick at which a start bit is too late for the telegram, if silence counts from edge `idle_since`.
  Tick silence_after(Tick idle_since) const { return (idle_since + gap_ + 1) * kTicksPerCycle; }
  void end_reply(Tick reply_end);
  void replied(const bus::ReceivedCharacter& character);

  void judge_stop(Tick next_edge);
  void value(Check check, Tick at, Tick measured, const std::string& what);

  Recorder& recorder_;
  const SerialSettings& settings_;
  SerialAccesses accesses_;
  State state_ = State::kOff;
  bool rxd_ = true;             ///< as seen by CLK
  std::optional<Edge> unseen_;  ///< since the last edge of CLK
  Tick rxd_rose_ = 0, rxd_fell_ = 0;
  RxdSampler sampler_;
  std::optional<StopBit> stop_bit_;
  HostTelegram request_{SerialPort::kUart};
  bool over_ = false;                               ///< kDeaf: the host has sent all of the disturbed telegram
  Tick gap_ = 0;                                    ///< the interval in cycles
  std::uint8_t interval_cell_ = 0, tsdr_cell_ = 0;  ///< B019, B01A
  // kReply
  bus::UartReceiver from_chip_;
  HostReply reply_;
  Tick asked_ = 0;                 ///< end of the request's last stop bit
  Tick tsdr_ = 0;                  ///< bit times
  std::optional<Tick> reply_end_;  ///< of the characters that have begun
  std::optional<Tick> talked_;     ///< RXD's first fall
  std::optional<Tick> free_;       ///< the chip has received since then, and RXD has not fallen yet
};

}  // namespace dsdpv1::checks
