#pragma once
// The telegrams of a host on SPI: the 2.7 us after a write (SP9), and ownership by B014 (SP12, SP16).
#include <cstddef>
#include <optional>

#include "kinds/dsdpv1/checks/check.hpp"
#include "kinds/dsdpv1/checks/host_telegram.hpp"
#include "kinds/dsdpv1/checks/serial_accesses.hpp"
#include "kinds/dsdpv1/checks/serial_settings.hpp"
#include "kinds/dsdpv1/checks/service.hpp"
#include "kinds/dsdpv1/port/spi_frame_reader.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

class SpiFrames : private tb::RsuFrameReader {
 public:
  /// `settings`, `station` and `duties` must outlive it.
  SpiFrames(Recorder& recorder, const SerialSettings& settings, const OwnStation& station, UserDuties& duties)
      : recorder_(recorder),
        settings_(settings),
        service_(recorder, station, Check::kOwnerInterval),
        accesses_(duties) {}

  void reset();
  /// A change of XSS, SCK, MOSI or MISO, not in reset.
  void pin(Tick at, Pin pin, Level level) { read(at, pin, level); }
  /// A telegram of the bus.
  void telegram(Tick now, const bus::WireTelegram& telegram);
  void finish(Tick end);

 private:
  /// Effect of a telegram unless the chip refuses it.
  enum class Effect : std::uint8_t { kNone, kClaim, kRelease, kReadAndWrite };

  void frame_began(Tick at) override;
  void byte(Tick at, std::uint8_t mosi, std::uint8_t miso) override;
  void frame_ended(Tick at) override;
  void judge_gap(Tick at);
  bool heard(Tick fell) const;
  void request_byte(Tick at, std::uint8_t byte);
  void request_complete(Tick at);
  void reply_byte(Tick at, std::uint8_t byte);
  void judge_reply(Tick at, bool begins);
  bool found_released() const;
  void settle();
  void release(Tick at);
  void owner_gone(Tick since, Tick at);
  /// Since when the host has held the chip off.
  std::optional<Tick> held_off_since() const;

  Recorder& recorder_;
  const SerialSettings& settings_;
  Service service_;
  SerialAccesses accesses_;
  bool heard_ = false;  ///< the chip receives the frame
  HostTelegram request_{SerialPort::kSpi};
  bool for_card_ = false, complete_ = false;
  unsigned idle_bytes_ = 0;                            ///< bytes of FF after the request
  HostReply reply_;                                    ///< from the first byte that is not FF
  bool replied_ = false;                               ///< it is complete
  Effect effect_ = Effect::kNone;                      ///< effect of this telegram, until its reply shows a refusal
  Tick asked_ = 0;                                     ///< last bit of the request
  std::optional<Tick> last_write_;                     ///< last bit of a write or read-and-write telegram
  std::optional<Tick> owned_since_, exclusive_since_;  ///< by B014; by a read-and-write telegram
};

}  // namespace dsdpv1::checks
